// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "models/continuum/atmosphere.hpp"
#include "models/continuum/filling.hpp"
#include "models/continuum/sector.hpp"
#include "models/continuum/time_scale.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

constexpr double millimetre = 1e-3;
constexpr double most_particles = 1e9;  // they and their images are numbered with 32 bits

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
  const double room = least_distance_of_layers(p);
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
  const double count = places_of(lattice);
  if (count <= most_particles) return true;
  const char* const keys[3] = {p.bed.right ? "bed.right" : "box.width", "box.depth", "bed.height"};
  const auto longest =
      static_cast<std::size_t>(std::max_element(lattice.count.begin(), lattice.count.end()) - lattice.count.begin());
  const double extent = lattice.spacing[static_cast<int>(longest)] * static_cast<double>(lattice.count[longest]);
  const double over = count / most_particles;
  std::array<std::int64_t, 3> sorted = lattice.count;
  std::sort(sorted.begin(), sorted.end());
  if (sorted[2] > 100 * sorted[1]) {
    problems.push_back({.key = keys[longest],
                        .what = fmt::format("{:.4g} m is {:.3g} spacings: the bed would hold {:.3g} particles", extent,
                                            static_cast<double>(lattice.count[longest]), count),
                        .allowed = fmt::format("at most {:.3g} m with this bed.spacing: {:.0e} particles",
                                               extent / over, most_particles)});
  } else {
    const double dimensions = static_cast<double>(
        std::count_if(lattice.count.begin(), lattice.count.end(), [](std::int64_t n) { return n > 1; }));
    problems.push_back(
        {.key = "bed.spacing",
         .what = fmt::format("{:.4g} mm makes {:.3g} particles", p.bed.spacing / millimetre, count),
         .allowed = fmt::format("at least {:.3g} mm: {:.0e} particles",
                                p.bed.spacing * std::pow(over, 1 / dimensions) / millimetre, most_particles)});
  }
  return false;
}

void check_bed(const Parameters& p, std::vector<Problem>& problems) {
  const auto add = [&](const char* key, std::string what, std::string allowed) {
    problems.push_back({.key = key, .what = std::move(what), .allowed = std::move(allowed)});
  };
  const Extent x = bed_along_x(p);
  if (!(x.low < x.high && x.high <= p.box.width))
    add(p.bed.right ? "bed.right" : "bed.left", "leaves no bed within the box", "bed.left < bed.right <= box.width");
  const double top = bed_bottom(p) + p.bed.height;
  if (top > p.box.height)
    add("bed.height", fmt::format("the bed would reach {:.4g} mm, past the top", top / millimetre),
        fmt::format("at most {:.4g} mm above its bottom", (p.box.height - bed_bottom(p)) / millimetre));
  const double shortest = std::min({x.high - x.low, p.box.depth, p.bed.height});
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
         .allowed = "walls that end within the box"});
  if (p.plate.height)
    problems.push_back({.key = "plate.height", .what = "a plate and a wedge together", .allowed = "one of them"});
}

void check_inclined_plates(const Parameters& p, std::vector<Problem>& problems) {
  const std::size_t taken = (p.plate.height ? 1 : 0) + (p.wedge.half_angle ? 3 : 0);
  if (taken + p.plates.size() > most_inner_walls)
    problems.push_back({.key = "plates",
                        .what = fmt::format("{} plates, gate and walls of a wedge counted", taken + p.plates.size()),
                        .allowed = fmt::format("at most {}", most_inner_walls)});
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

std::vector<Problem> check(const Parameters& given) {
  std::vector<Problem> problems;
  check_faces(given, problems);
  check_plate(given, problems);
  check_wedge(given, problems);
  check_inclined_plates(given, problems);
  for (const Problem& problem : check_vessel(given)) problems.push_back(problem);
  for (const Problem& problem : check_sector(given)) problems.push_back(problem);
  if (problems.empty()) problems = check_symmetry(given);
  // How far a mass fills a vessel can be said of a sound vessel only.
  const Parameters p = problems.empty() ? with_level(given) : given;
  if (!p.bed.mass || p.bed.height > 0) check_bed(p, problems);
  check_materials(p, problems);
  if (p.settle.loading_time && *p.settle.loading_time >= time_scales_of(p).settling_limit)
    problems.push_back({.key = "settle.loading_time",
                        .what = fmt::format("{:g} s: the bed could not settle before", *p.settle.loading_time),
                        .allowed = fmt::format("less than settle.longest, {:g} s", time_scales_of(p).settling_limit)});
  for (const Problem& problem : granular::check(p.law)) problems.push_back(problem);
  for (const Problem& problem : check_air(p)) problems.push_back(problem);
  if (p.collisions.form != granular::Collisions::none && !(p.gravity.acceleration > 0))
    problems.push_back({.key = "collisions.form",
                        .what = "Eqs 13 and 14 measure rates by (g/D)^(1/2), and there is no gravity",
                        .allowed = "none without gravity"});
  if (!problems.empty()) return problems;
  for (const Problem& problem : check_mass(p)) problems.push_back(problem);
  for (const Problem& problem : check_inlets(p)) problems.push_back(problem);
  return problems;
}

}  // namespace talus::continuum
