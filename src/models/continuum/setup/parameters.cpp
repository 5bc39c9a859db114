// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "base/unit.hpp"
#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/sector.hpp"
#include "models/continuum/setup/bed.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/setup/time_scale.hpp"
#include "models/continuum/setup/vessel_bed.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

constexpr double max_particles = 1e9;  // they and their images are numbered with 32 bits

void check_faces(const Parameters& p, std::vector<Problem>& problems) {
  const auto pair = [&](const char* first, FaceKind a, const char* second, FaceKind b) {
    if ((a == FaceKind::periodic) == (b == FaceKind::periodic)) return;
    const bool first_is = a == FaceKind::periodic;
    problems.push_back({.key = first_is ? second : first,
                        .what = fmt::format("is not periodic, but {} is", first_is ? first : second),
                        .allowed = "both or neither"});
  };
  pair("box.left", p.box.left, "box.right", p.box.right);
  pair("box.front", p.box.front, "box.rear", p.box.rear);
  pair("box.floor", p.box.floor, "box.top", p.box.top);
}

void check_plate(const Parameters& p, std::vector<Problem>& problems) {
  const auto add = [&](const char* key, std::string what, std::string allowed) {
    problems.push_back({.key = key, .what = std::move(what), .allowed = std::move(allowed)});
  };
  if (!p.plate.height) {
    if (p.plate.slit_left || p.plate.slit_right)
      add(p.plate.slit_left ? "plate.slit_left" : "plate.slit_right", "given, but there is no plate", "plate.height");
    return;
  }
  const double room = min_distance_of_layers(p);
  if (*p.plate.height < room || *p.plate.height > p.box.height - room)
    add("plate.height", fmt::format("{:.4g} mm is too near to floor or top", *p.plate.height / millimetre),
        fmt::format("{:.4g} to {:.4g} mm: six spacings from both", room / millimetre,
                    (p.box.height - room) / millimetre));
  if (p.plate.slit_left.has_value() != p.plate.slit_right.has_value()) {
    add(p.plate.slit_left ? "plate.slit_right" : "plate.slit_left", "missing: the slit needs both its ends",
        "a length");
  } else if (p.plate.slit_left && !(*p.plate.slit_left < *p.plate.slit_right && *p.plate.slit_right <= p.box.width)) {
    add("plate.slit_right", fmt::format("{:.4g} mm leaves no slit", *p.plate.slit_right / millimetre),
        "above plate.slit_left, at most box.width");
  }
}

/// Whether the bed is of a size that can be numbered; the fault is told of the length that is out of proportion, or of
/// the spacing where none is.
bool check_size(const Parameters& p, std::vector<Problem>& problems) {
  const Lattice lattice = lattice_of(p);
  const double count = lattice.positions();
  if (count <= max_particles) return true;
  const char* const keys[3] = {p.bed.right ? "bed.right" : "box.width", p.bed.rear ? "bed.rear" : "box.depth",
                               "bed.height"};
  const auto longest =
      static_cast<std::size_t>(std::max_element(lattice.count.begin(), lattice.count.end()) - lattice.count.begin());
  const double extent = lattice.spacing[static_cast<int>(longest)] * static_cast<double>(lattice.count[longest]);
  const double over = count / max_particles;
  std::array<std::int64_t, 3> sorted = lattice.count;
  std::sort(sorted.begin(), sorted.end());
  if (sorted[2] > 100 * sorted[1]) {
    problems.push_back({.key = keys[longest],
                        .what = fmt::format("{:.4g} m is {:.3g} spacings: the bed would hold {:.3g} particles", extent,
                                            static_cast<double>(lattice.count[longest]), count),
                        .allowed = fmt::format("at most {:.3g} m with this bed.spacing: {:.0e} particles",
                                               extent / over, max_particles)});
  } else {
    const double dimensions = static_cast<double>(
        std::count_if(lattice.count.begin(), lattice.count.end(), [](std::int64_t n) { return n > 1; }));
    problems.push_back(
        {.key = "bed.spacing",
         .what = fmt::format("{:.4g} mm makes {:.3g} particles", p.bed.spacing / millimetre, count),
         .allowed = fmt::format("at least {:.3g} mm: {:.0e} particles",
                                p.bed.spacing * std::pow(over, 1 / dimensions) / millimetre, max_particles)});
  }
  return false;
}

using Add = std::function<void(const char* key, std::string what, std::string allowed)>;

/// Where the bed begins and ends along an axis, and what says so: a key, or what is taken where it is left out.
/// \returns whether there is room for a bed
bool check_extent(const Parameters& p, int axis, const Add& add) {
  const bool along_x = axis == 0;
  const Extent extent = along_x ? bed_along_x(p) : bed_along_y(p);
  const double width = along_x ? p.box.width : p.box.depth;
  if (extent.low < extent.high && extent.high <= width) return true;
  const bool first = (along_x ? p.bed.left : p.bed.front).has_value();
  const bool last = (along_x ? p.bed.right : p.bed.rear).has_value();
  const char* const first_key = along_x ? "bed.left" : "bed.front";
  const char* const last_key = along_x ? "bed.right" : "bed.rear";
  const char* const width_key = along_x ? "box.width" : "box.depth";
  const auto origin = [&](bool given, const char* key, const char* face, double value, double of_face, bool low) {
    if (given) return std::string(key);
    if (value == of_face) return fmt::format("{} by default, the {} face", key, face);
    return fmt::format("{} by default, the {} {} of the vessel", key, low ? "least" : "largest", "xy"[axis]);
  };
  add(last ? last_key : first_key,
      fmt::format("leaves no bed within the box: from {:.4g} mm ({}) to {:.4g} mm ({})", extent.low / millimetre,
                  origin(first, first_key, along_x ? "left" : "front", extent.low, 0, true), extent.high / millimetre,
                  origin(last, last_key, along_x ? "right" : "rear", extent.high, width, false)),
      fmt::format("{} < {} <= {}{}", first_key, last_key, width_key,
                  first && last ? "" : fmt::format("; give {} as well", first ? last_key : first_key)));
  return false;
}

/// Whether the bed begins somewhere.
void check_inside(const Layout& layout, const Add& add) {
  const Parameters& p = layout.given;
  if (has_unread_file(p)) return;
  if (p.bed.inside) {
    const auto& x = *p.bed.inside;
    const bool inside =
        x[0] >= 0 && x[0] <= p.box.width && x[1] >= 0 && x[1] <= p.box.depth && x[2] >= 0 && x[2] <= p.box.height;
    if (!inside) return add("bed.inside", "is not within the box", "a place within it");
    const Extent along_x = bed_along_x(p), along_y = bed_along_y(p);
    const bool within = x[0] >= along_x.low && x[0] <= along_x.high && x[1] >= along_y.low && x[1] <= along_y.high &&
                        x[2] >= bed_bottom(p);
    if (!within)
      return add("bed.inside", "is not where the bed may lie",
                 fmt::format("x from {:.4g} to {:.4g} mm, y from {:.4g} to {:.4g} mm, z from {:.4g} mm on: as "
                             "bed.left, bed.right, bed.front, bed.rear and bed.bottom say",
                             along_x.low / millimetre, along_x.high / millimetre, along_y.low / millimetre,
                             along_y.high / millimetre, bed_bottom(p) / millimetre));
  }
  if (p.vessel.empty() ? bed_count(layout) > 0 : !VesselPlaces(layout).seeds().empty()) return;
  if (p.bed.inside)
    return add("bed.inside", "sees no place for a particle: walls are too near",
               "a place farther from walls, or a smaller bed.spacing");
  add(p.bed.mass ? "bed.mass" : "bed.height", "leaves no particle: the middle of the bed's top lies in a wall",
      "bed.inside, a place within the bed");
}

void check_bed(const Parameters& p, std::vector<Problem>& problems) {
  const Add add = [&](const char* key, std::string what, std::string allowed) {
    problems.push_back({.key = key, .what = std::move(what), .allowed = std::move(allowed)});
  };
  if (p.bed.given) {
    for (Problem& problem : check_given_bed(p)) problems.push_back(std::move(problem));
    return;
  }
  const bool along_x = check_extent(p, 0, add), along_y = check_extent(p, 1, add);
  if (!along_x || !along_y || beds_of(p).empty()) return;
  const double top = bed_bottom(p) + p.bed.height;
  constexpr double rounding = 1 + 1e-12;
  if (top > rounding * p.box.height)
    add("bed.height", fmt::format("the bed would reach {:.4g} mm, past the top", top / millimetre),
        fmt::format("at most {:.4g} mm above its bottom", (p.box.height - bed_bottom(p)) / millimetre));
  const Extent x = bed_along_x(p), y = bed_along_y(p);
  const double shortest = std::min({x.high - x.low, y.high - y.low, p.bed.height});
  if (shortest < 0.5 * p.bed.spacing)
    add("bed.spacing", fmt::format("{:.4g} mm is more than twice the bed's least extent", p.bed.spacing / millimetre),
        fmt::format("at most {:.4g} mm", 2 * shortest / millimetre));
  if (!check_size(p, problems)) return;
  const Lattice lattice = lattice_of(p);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(lattice.spacing[axis] / p.bed.spacing - 1) > 0.15)
      add("bed.spacing",
          fmt::format("along {} the particles would stand {:.4g} mm apart", "xyz"[axis],
                      lattice.spacing[axis] / millimetre),
          "a spacing that divides the bed's width, the box's depth and the bed's height nearly evenly");
}

void check_wedge(const Parameters& p, std::vector<Problem>& problems) {
  if (!p.wedge.half_angle) {
    if (p.wedge.outlet > 0 || p.wedge.height > 0)
      problems.push_back({.key = p.wedge.outlet > 0 ? "wedge.outlet" : "wedge.height",
                          .what = "given, but there is no wedge",
                          .allowed = "wedge.half_angle"});
    return;
  }
  if (!(p.wedge.outlet < p.box.width))
    problems.push_back({.key = "wedge.outlet",
                        .what = fmt::format("{:.4g} mm leaves no walls", p.wedge.outlet / millimetre),
                        .allowed = fmt::format("below {:.4g} mm, box.width", p.box.width / millimetre)});
  const double rise = 0.5 * (p.box.width - p.wedge.outlet) / std::tan(*p.wedge.half_angle);
  if (p.wedge.height + rise > p.box.height)
    problems.push_back(
        {.key = "wedge.height",
         .what = fmt::format("the walls would reach {:.4g} mm, past the top", (p.wedge.height + rise) / millimetre),
         .allowed = "walls that end within the box: a larger half angle, or a higher box (of talus new: --fill)"});
  if (p.plate.height)
    problems.push_back({.key = "plate.height", .what = "a plate and a wedge together", .allowed = "one of them"});
}

void check_inclined_plates(const Parameters& p, std::vector<Problem>& problems) {
  const std::size_t taken = (p.plate.height ? 1 : 0) + (p.wedge.half_angle ? 3 : 0);
  if (taken + p.plates.size() > max_inner_walls)
    problems.push_back({.key = "plates",
                        .what = fmt::format("{} plates, gate and walls of a wedge counted", taken + p.plates.size()),
                        .allowed = fmt::format("at most {}", max_inner_walls)});
  for (std::size_t n = 0; n < p.plates.size(); ++n) {
    const auto& plate = p.plates[n];
    const auto add = [&](int key, std::string what, std::string allowed) {
      problems.push_back({.key = plate_key(n, key), .what = std::move(what), .allowed = std::move(allowed)});
    };
    if (plate.from.size() != 2 || plate.to.size() != 2) {
      add(plate.from.size() != 2 ? 0 : 1, "is no place", "two lengths, x and z: [\"10 mm\", \"50 mm\"]");
      continue;
    }
    const double length = std::hypot(plate.to[0] - plate.from[0], plate.to[1] - plate.from[1]);
    if (!(length > p.bed.spacing)) add(1, "leaves a plate shorter than bed.spacing", "another place");
    double end = 0;
    bool in_order = plate.openings.size() % 2 == 0;
    for (const double place : plate.openings) in_order = in_order && place >= end && place <= length, end = place;
    if (!in_order)
      add(2, "are no pairs of places along the plate",
          fmt::format("an even number of lengths, rising, up to {:.4g} mm", length / millimetre));
    if (plate.opens_after && plate.openings.empty()) add(3, "given, but there are no openings", "openings");
  }
}

/// Walls of a material rub as the grains' material says. Without one, or on a wall that its file does not know, there
/// is no friction to take (app/materials) unless the case gives it.
void check_materials(const Parameters& p, std::vector<Problem>& problems) {
  if (p.grains.material) return;
  const auto refuse = [&](std::string key) {
    problems.push_back(
        {.key = std::move(key), .what = "the grains have no material", .allowed = "a wall's with grains.material"});
  };
  if (p.walls.material) refuse("walls.material");
  for (std::size_t n = 0; n < p.vessel.size(); ++n)
    if (p.vessel[n].material) refuse(vessel_key(n, "material"));
}

}  // namespace

std::string plate_key(std::size_t n, int key) {
  constexpr const char* names[4] = {"from", "to", "openings", "opens_after"};
  return fmt::format("plates.{}.{}", n + 1, names[key]);
}

namespace {

/// Of a bed of [[beds]], whose keys stand for those of [bed].
std::vector<Problem> renamed(std::vector<Problem> problems, std::size_t bed) {
  if (bed == 0) return problems;
  constexpr std::string_view names[] = {"mass", "height", "bottom", "left", "right", "front", "rear", "inside"};
  const auto rename = [&](std::string& text) {
    for (const std::string_view name : names) {
      const std::string old = fmt::format("bed.{}", name), now = beds_key(bed - 1, name);
      for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + now.size()))
        text.replace(at, old.size(), now);
    }
  };
  for (Problem& problem : problems) rename(problem.key), rename(problem.what), rename(problem.allowed);
  return problems;
}

/// Beds of particles of another mass, or in each other. \pre each is sound
void check_beds_together(const Layout& layout, std::vector<Problem>& problems) {
  const Parameters& p = layout.given;
  constexpr double max_difference = 0.02, min_apart = 0.5;  // of the mass; in spacings
  std::vector<Vector3> positions;
  std::vector<std::size_t> bed_of;
  const auto name = [](std::size_t n) { return n == 0 ? std::string("[bed]") : fmt::format("[[beds]] {}", n); };
  const double mass = layout.lattice.mass;
  for (const std::size_t n : layout.beds) {
    const Layout one = layout.with_bed_alone(n);
    if (const double own = one.lattice.mass; !(std::abs(own / mass - 1) <= max_difference))
      problems.push_back({.key = beds_key(n - 1, "height"),
                          .what = fmt::format("particles of {} would have {:.3g} times the mass of those of {}",
                                              name(n), own / mass, name(layout.beds.front())),
                          .allowed = "extents of the beds that are whole numbers of bed.spacing"});
    for (const Vector3& x : bed_positions(one)) positions.push_back(x), bed_of.push_back(n);
  }
  if (positions.empty()) return;
  const CellGrid grid(positions, min_apart * p.bed.spacing);
  for (std::size_t i = 0; i < positions.size(); ++i)
    grid.for_each_candidate(positions[i], [&](std::uint32_t j) {
      if (bed_of[j] <= bed_of[i] || norm(positions[i] - positions[j]) >= min_apart * p.bed.spacing) return;
      const std::string key = beds_key(bed_of[j] - 1, "bottom");
      const bool told = std::any_of(problems.begin(), problems.end(), [&](const Problem& q) { return q.key == key; });
      if (told) return;
      const Vector3& x = positions[j];
      problems.push_back({.key = key,
                          .what = fmt::format("{} overlaps {} at ({:.4g}, {:.4g}, {:.4g}) mm", name(bed_of[j]),
                                              name(bed_of[i]), x.x / millimetre, x.y / millimetre, x.z / millimetre),
                          .allowed = "beds apart from each other: bottom, left, right, front and rear bound each"});
    });
}

}  // namespace

bool is_loose_where_free(const Parameters& p) {
  return !granular::bears_tension(p.law);
}

double density_relaxation(const Parameters& p) {
  const bool flows = p.law.is<granular::CriticalState>() || !granular::bears_tension(p.law);
  return flows ? p.sph.density_relaxation : 0;
}

bool draws_by_lasting_rate(const Parameters& p) {
  return !p.vessel.empty() && density_relaxation(p) > 0;
}

double stress_regularisation(const Parameters& p) {
  return p.law.is<granular::CriticalState>() ? p.sph.stress_regularisation : 0;
}

bool has_cohesion(const Parameters& p) {
  return p.law.is<granular::CriticalState>() && granular::bears_tension(p.law);
}

double artificial_stress(const Parameters& p) {
  return has_cohesion(p) ? p.sph.artificial_stress : 0;
}

double wall_adhesion(const Parameters& p, const std::optional<double>& of_part) {
  return has_cohesion(p) && p.walls.friction == Friction::coulomb ? of_part.value_or(p.walls.adhesion) : 0;
}

std::vector<Problem> check(const Parameters& given) {
  std::vector<Problem> problems;
  check_faces(given, problems);
  check_plate(given, problems);
  check_wedge(given, problems);
  check_inclined_plates(given, problems);
  std::vector<Problem> of_vessel = check_vessel(given);
  const std::vector<Problem> outside = of_vessel.empty() ? check_extents(given) : std::vector<Problem>{};
  of_vessel.insert(of_vessel.end(), outside.begin(), outside.end());
  problems.insert(problems.end(), of_vessel.begin(), of_vessel.end());
  for (const Problem& problem : check_sector(given)) problems.push_back(problem);
  // The layout of a sound boundary, with beds as high as their mass makes them.
  std::optional<Layout> layout;
  const bool sized = given.bed.spacing > 0 && given.box.width > 0 && given.box.depth > 0 && given.box.height > 0;
  if (problems.empty() && sized) {
    layout.emplace(given);
    problems = check_symmetry(*layout);
    if (problems.empty()) layout = with_level(*layout);
  }
  const Parameters& p = layout ? layout->given : given;
  const std::vector<std::size_t> beds = p.beds.empty() ? std::vector<std::size_t>{0} : beds_of(p);
  const auto check_each = [&](auto&& check_one) {
    for (const std::size_t n : beds)
      for (Problem& problem : renamed(check_one(n), n)) problems.push_back(std::move(problem));
  };
  check_each([&](std::size_t n) {
    const Parameters one = with_bed_alone(p, n);
    std::vector<Problem> of_bed;
    // A bed in walls that are elsewhere has faults of its own.
    if (outside.empty() && (!one.bed.mass || one.bed.height > 0)) check_bed(one, of_bed);
    return of_bed;
  });
  check_materials(p, problems);
  if (const double limit = time_scales_of(p).settling_limit; p.settle.loading_time && *p.settle.loading_time >= limit)
    problems.push_back({.key = "settle.loading_time",
                        .what = fmt::format("{:g} s: the bed could not settle before", *p.settle.loading_time),
                        .allowed = fmt::format("less than settle.max_time, {:g} s", limit)});
  for (const auto& found : {granular::check(p.law), check_air(p), check_levels(p)})
    problems.insert(problems.end(), found.begin(), found.end());
  if (p.collisions.form != granular::Collisions::none && !(p.gravity.acceleration > 0))
    problems.push_back({.key = "collisions.form",
                        .what = "Eqs 13 and 14 measure rates by (g/D)^(1/2), and there is no gravity",
                        .allowed = "none without gravity"});
  const bool is_plain = p.vessel.empty() && p.plates.empty() && !p.plate.height && !p.wedge.half_angle;
  if (p.gravity.tilt > 0 && (p.air.enabled || !is_plain))
    problems.push_back({.key = "gravity.tilt",
                        .what = p.air.enabled
                                    ? "the air's gravity is along -z"
                                    : "loads and discharge of vessels, plates and wedges are reckoned along -z",
                        .allowed = p.air.enabled ? "0 with air" : "0 but in a plain box"});
  if (!problems.empty() || !layout) return problems;
  check_each([&](std::size_t n) { return check_mass(layout->with_bed_alone(n)); });
  for (const Problem& problem : check_inlets(*layout)) problems.push_back(problem);
  if (!problems.empty()) return problems;
  check_each([&](std::size_t n) {
    const Layout one = layout->with_bed_alone(n);
    std::vector<Problem> of_bed;
    if (one.given.bed.given || one.has_no_bed()) return of_bed;
    check_inside(one, [&](const char* key, std::string what, std::string allowed) {
      of_bed.push_back({.key = key, .what = std::move(what), .allowed = std::move(allowed)});
    });
    return of_bed;
  });
  if (problems.empty() && !p.beds.empty()) check_beds_together(*layout, problems);
  return problems.empty() ? check_levels(*layout) : problems;
}

}  // namespace talus::continuum
