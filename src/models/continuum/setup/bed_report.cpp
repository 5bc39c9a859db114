// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/bed_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

#include "base/unit.hpp"
#include "models/continuum/setup/forecast.hpp"
#include "models/continuum/setup/vessel_bed.hpp"

namespace talus::continuum {

namespace {

constexpr double max_reported = 1e6;          // particles
constexpr double max_positions_around = 3e5;  // of a region that is examined
constexpr double beside = 0.8;                // of a wall, in spacings
constexpr double margin = 2;                  // of the region around the vessel, in spacings
constexpr double wide_open = 6;               // in spacings
constexpr std::size_t max_viewpoints = 200;   // places

std::string place_text(const Vector3& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", x.x / millimetre, x.y / millimetre, x.z / millimetre);
}

/// The vessel with a region that reaches a little beyond it wherever its extent bounds the bed.
struct Surroundings {
  Parameters parameters;
  Vector3 low, high;  ///< of the bed's lattice; infinite where something else bounds it
  bool sector = false;

  explicit Surroundings(const Parameters& p) : parameters(p), sector(p.box.sector.has_value()) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    low = {-infinity, -infinity, -infinity}, high = {infinity, infinity, infinity};
    const Lattice lattice = lattice_of(p);
    const VesselBounds vessel = bounds_of_vessel(p);
    const auto widen = [&](int axis, double width, const Extent& bed, std::optional<double>& first,
                           std::optional<double>& last) {
      if (!(vessel.low[axis] > 0 && vessel.high[axis] < width)) return;
      const double spacing = lattice.spacing[axis];
      const auto room = [&](double free) { return spacing * std::clamp(std::floor(free / spacing), 0.0, margin); };
      double below = first ? 0 : room(bed.low), above = last ? 0 : room(width - bed.high);
      if (sector) below = above = std::min(below, above);
      if (below > 0) low[axis] = bed.low;
      if (above > 0) high[axis] = bed.high;
      first = bed.low - below, last = bed.high + above;
    };
    auto& bed = parameters.bed;
    widen(0, p.box.width, bed_along_x(p), bed.left, bed.right);
    widen(1, p.box.depth, bed_along_y(p), bed.front, bed.rear);
    if (p.gate.opens == GateOpens::from_the_start) return;  // what is open is to flow
    // Down to below the vessel, wherever in it the bed begins.
    const double bottom = bed_bottom(p), spacing = lattice.spacing.z;
    const double down = std::ceil(std::max(0.0, bottom - vessel.low.z) / spacing - 1e-9) + margin;
    const double below = spacing * std::min(down, std::floor(bottom / spacing));
    if (!(bottom - below < vessel.low.z)) return;
    low.z = std::min(bottom, vessel.low.z), bed.bottom = bottom - below, bed.height += below;
  }

  bool are_outside(const VesselPlaces& places, const Vector3& x) const {
    if (x.z < low.z) return true;
    if (sector) return places.domain.sector()->radius(x) > 0.5 * (high.x - low.x);
    return x.x < low.x || x.x > high.x || x.y < low.y || x.y > high.y;
  }
};

/// Whether walls of the vessel are on both sides of a place, along x or along y.
bool is_between_walls(const Surface& surface, const Vector3& x) {
  for (int axis = 0; axis < 2; ++axis) {
    Vector3 low = x, high = x;
    low[axis] = std::min(surface.low()[axis], x[axis]) - 1, high[axis] = std::max(surface.high()[axis], x[axis]) + 1;
    if (surface.blocks(x, low) && surface.blocks(x, high)) return true;
  }
  return false;
}

/// Where the region passes out, if it does: the narrowest place of the widest way to a place outside from the one
/// within walls that is farthest from them, of several the shortest; where nothing is narrow the place outside.
std::optional<Vector3> way_out(const VesselPlaces& places, const Surroundings& around,
                               const std::vector<VesselPlaces::Index>& bed) {
  using Index = VesselPlaces::Index;
  const double most = wide_open * places.layout.given.bed.spacing;
  const auto clearance = [&](const Vector3& x) {
    const auto foot = places.surface.nearest(x, most);
    return foot ? foot->distance : most;
  };
  struct Step {
    double narrowest;
    std::size_t length;
    Index at, narrow;
    bool operator<(const Step& other) const {
      return std::tuple(narrowest, other.length) < std::tuple(other.narrowest, length);
    }
  };
  std::vector<char> done(places.taken.size());
  std::priority_queue<Step> next;
  const std::size_t stride = 1 + bed.size() / max_viewpoints;
  std::optional<Step> start;
  for (std::size_t n = 0; n < bed.size(); n += stride)
    if (const Vector3 x = places.at(bed[n]); is_between_walls(places.surface, x))
      if (const Step from{clearance(x), 0, bed[n], bed[n]}; !start || *start < from) start = from;
  if (!start) return std::nullopt;
  next.push(*start);
  while (!next.empty()) {
    const Step step = next.top();
    next.pop();
    if (std::exchange(done[places.number(step.at)], char{1})) continue;
    const Vector3 x = places.at(step.at);
    if (around.are_outside(places, x)) return step.narrowest < most ? places.at(step.narrow) : x;
    places.for_each_beside(step.at, [&](const Index& n) {
      const std::size_t number = places.number(n);
      if (!places.taken[number] || done[number]) return;
      const Vector3 y = places.at(n);
      if (places.is_hidden(x, y)) return;
      const double room = clearance(y);
      next.push({std::min(step.narrowest, room), step.length + 1, n, room < step.narrowest ? n : step.narrow});
    });
  }
  return std::nullopt;
}

/// Whether a place lies above an opening, with nothing between.
bool is_above(const Surface& surface, const LevelOpening& opening, double spacing, const Vector3& x) {
  if (x.z < opening.low.z || x.x < opening.low.x - spacing || x.x > opening.high.x + spacing ||
      x.y < opening.low.y - spacing || x.y > opening.high.y + spacing)
    return false;
  return !surface.blocks(x, opening.middle + Vector3{0, 0, 0.01 * spacing});
}

/// With particles so large that the region has no more than max_positions_around.
Surroundings around_bed(const Parameters& p) {
  Parameters q = p;
  q.bed.mass = std::nullopt;
  while (true) {
    Surroundings around(q);
    if (lattice_of(around.parameters).positions() <= max_positions_around) return around;
    q.bed.spacing *= std::cbrt(2.0);
  }
}

}  // namespace

BedReport report_of_bed(const Layout& layout) {
  const Parameters& p = layout.given;
  const double count = bed_count(layout);
  BedReport report;
  report.particles = layout.copies * std::round(share_of_particles(layout) * count);
  report.mass = layout.copies * count * layout.lattice.mass;
  const Layout shown = count > max_reported ? Layout(coarser(layout, max_reported)) : layout;
  const std::vector<Vector3> positions = bed_positions(shown);
  if (positions.empty()) return report;
  const double spacing = shown.given.bed.spacing, half = 0.5 * spacing;
  const Surface& surface = shown.boundary->vessel();
  const Domain& domain = shown.boundary->domain();
  const Vector3 size{p.box.width, p.box.depth, p.box.height};
  std::vector<char> of_vessel(p.vessel.size()), of_domain(static_cast<std::size_t>(domain.wall_count()));
  report.low = report.high = positions.front();
  double radius = 0;
  for (const Vector3& x : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      report.low[axis] = std::min(report.low[axis], x[axis]), report.high[axis] = std::max(report.high[axis], x[axis]);
      for (const int side : {0, 1}) {
        const auto face = static_cast<std::size_t>(2 * axis + side);
        if (!domain.sector() || axis == 2)
          of_domain[face] |= (side == 0 ? x[axis] : size[axis] - x[axis]) < beside * spacing;
      }
    }
    if (domain.sector()) radius = std::max(radius, domain.sector()->radius(x));
    for (int wall = wall_number(0); wall < domain.wall_count(); ++wall)
      of_domain[static_cast<std::size_t>(wall)] |=
          std::abs(domain.above(wall, x)) < beside * spacing && domain.is_beside(wall, x);
    if (const auto foot = surface.nearest(x, beside * spacing))
      of_vessel[surface.triangles()[foot->triangle].patch] = 1;
  }
  report.low = report.low - Vector3{half, half, half}, report.high = report.high + Vector3{half, half, half};
  if (domain.sector())
    for (int axis = 0; axis < 2; ++axis)
      report.low[axis] = domain.sector()->axis()[axis] - radius - half,
      report.high[axis] = domain.sector()->axis()[axis] + radius + half;
  for (std::size_t n = 0; n < of_vessel.size(); ++n)
    if (of_vessel[n]) report.beside.push_back(name_of(p, n));
  constexpr const char* faces[] = {"left face", "right face", "front face", "rear face", "floor", "top"};
  for (std::size_t n = 0; n < of_domain.size(); ++n) {
    if (!of_domain[n]) continue;
    if (n >= 6) {
      report.beside.push_back(domain.walls()[n - 6].name());
      continue;
    }
    const FaceKind kind = domain.box().faces[n];
    report.beside.push_back(kind == FaceKind::wall ? faces[n] : fmt::format("{} ({})", faces[n], choice_name(kind)));
  }
  return report;
}

namespace {

void add_taken_away(const Parameters& p, double lowest, std::vector<RegimeLine>& lines) {
  if (!p.removal.below || !(lowest < *p.removal.below)) return;
  lines.push_back(
      {"grains taken away at once", fmt::format("{:.4g} mm", lowest / millimetre),
       fmt::format("the bed reaches below removal.below, {:.4g} mm: what lies there is gone after the first "
                   "step",
                   *p.removal.below / millimetre),
       true});
}

/// Of a bed alone. \returns whether it lies above a gate
bool examine_bed(const Layout& layout, std::vector<RegimeLine>& lines) {
  const Parameters& p = layout.given;
  const Surroundings around = around_bed(p);
  const Layout region =
      around.parameters.bed.spacing > p.bed.spacing ? Layout(around.parameters) : layout.with(around.parameters);
  std::vector<Vector3> bed;
  const Surface& surface = region.boundary->vessel();
  if (p.bed.given) {
    bed = p.bed.given->position;
  } else {
    VesselPlaces places(region);
    places.fill();
    bool passes_out = false;
    std::vector<VesselPlaces::Index> within;
    for (VesselPlaces::Index n{0, 0}; n.layer < places.layers; ++n.layer)
      for (n.place = 0; n.place < places.layer.places.size(); ++n.place) {
        if (!places.taken[places.number(n)]) continue;
        const Vector3 x = places.at(n);
        if (around.are_outside(places, x))
          passes_out = true;
        else
          bed.push_back(x), within.push_back(n);
      }
    const auto out = passes_out ? way_out(places, around, within) : std::nullopt;
    if (passes_out && !out && !bed.empty())
      lines.push_back({"bed outside the vessel", place_text(bed.front()),
                       "no grain lies between walls of the vessel, whose extent alone bounds the bed; bed.inside is a "
                       "place within the walls",
                       true});
    else if (out)
      lines.push_back({"way out of the vessel", place_text(*out),
                       "the region of the bed goes on there beyond the vessel's extent, and grains will flow out: a "
                       "hole or a gap between walls, a rim below the bed's top, or an outlet without a gate",
                       true});
  }
  const auto lowest = std::min_element(bed.begin(), bed.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  if (lowest != bed.end()) add_taken_away(p, lowest->z, lines);
  const auto falls = [&](const Vector3& x) {
    return !surface.blocks(x, {x.x, x.y, std::min(-1.0, surface.low().z - 1)}) && !is_between_walls(surface, x);
  };
  if (p.box.floor == FaceKind::open && 2 * std::count_if(bed.begin(), bed.end(), falls) > std::ssize(bed))
    lines.push_back({"nothing below the bed", place_text(*std::find_if(bed.begin(), bed.end(), falls)),
                     "neither a wall nor the floor is below most grains of the bed: they fall out of the box; "
                     "bed.bottom, or bed.inside on the other side of a wall",
                     true});
  const std::vector<LevelOpening> openings = level_openings(layout);
  return std::any_of(openings.begin(), openings.end(), [&](const LevelOpening& opening) {
    return std::any_of(bed.begin(), bed.end(),
                       [&](const Vector3& x) { return is_above(surface, opening, around.parameters.bed.spacing, x); });
  });
}

}  // namespace

std::vector<RegimeLine> regime_of_bed(const Layout& layout) {
  std::vector<RegimeLine> lines;
  if (layout.has_no_bed()) return lines;
  if (layout.given.vessel.empty()) {
    for (const std::size_t n : layout.beds) add_taken_away(layout.given, layout.with_bed_alone(n).bottom, lines);
    return lines;
  }
  bool above = false;
  for (const std::size_t n : layout.beds) above = examine_bed(layout.with_bed_alone(n), lines) || above;
  const std::vector<LevelOpening> openings = level_openings(layout);
  if (!above && !openings.empty() && openings.front().is_gate)
    lines.push_back({"gate without grains", openings.front().name,
                     fmt::format("no grain lies above the gate at {}: bed.inside is a place within the bed",
                                 place_text(openings.front().middle)),
                     true});
  return lines;
}

}  // namespace talus::continuum
