// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/bed_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "models/continuum/setup/vessel_bed.hpp"

namespace talus::continuum {

namespace {

constexpr double max_places = 2e6;  // of a lattice by which walls are found; a sector looks at its share of them
constexpr double view = 1.05;       // in spacings: past the next place, and as near to it as walls may be
constexpr double max_lean = 0.1;    // of upright walls: the normal's |z|
constexpr double of_rounding = 1e-9,
                 of_polygon = 0.02;  // by which a wall differs from the bounds of its part, spacings

/// Where a place sees a wall first.
struct Sight {
  double reach = -std::numeric_limits<double>::infinity();  ///< towards the side, m
  std::uint32_t triangle = 0;
  bool along = false;  ///< whether the triangle's normal points to the side too
};

bool same_place(const BedRegion& a, const BedRegion& b) {
  return a.height == b.height && a.bottom == b.bottom && a.left == b.left && a.right == b.right && a.front == b.front &&
         a.rear == b.rear && a.inside == b.inside;
}

bool is_of(const BedWalls& walls, const Parameters& p, const std::shared_ptr<const Boundary>& boundary) {
  return walls.boundary.lock() == boundary && walls.spacing == p.bed.spacing && same_place(walls.region, p.bed);
}

/// The sights of all places, side by side of the lattice; of a sector one, away from the axis. None where a place at
/// the edge of the lattice sees no wall.
std::vector<std::optional<Sight>> sights_of(const VesselPlaces& places) {
  const auto& sector = places.domain.sector();
  const auto& count = places.lattice.count;
  std::vector<Sight> farthest(sector ? 1 : 4);
  std::vector<char> is_open(farthest.size());
  /// \returns whether it sees one
  const auto look = [&](std::size_t side, const Vector3& x, const Vector3& direction, double length, auto&& reach_of) {
    const Vector3 y = x + length * direction;
    const auto seen = places.surface.first_crossing(x, y);
    if (!seen) return false;
    if (const double reach = reach_of(x + seen->at * (y - x)); reach > farthest[side].reach)
      farthest[side] = {reach, seen->triangle, dot(places.surface.normal(seen->triangle), direction) > 0};
    return true;
  };
  for (VesselPlaces::Index n{0, 0}; n.layer < places.layers; ++n.layer)
    for (n.place = 0; n.place < places.layer.places.size(); ++n.place) {
      if (!places.taken[places.number(n)]) continue;
      const Vector3 x = places.at(n);
      if (sector) {
        const double radius = sector->radius(x), edge = 0.5 * static_cast<double>(count[0]) * places.lattice.spacing.x;
        if (!(radius > 0)) continue;
        Vector3 outwards = (1 / radius) * (x - sector->axis());
        outwards.z = 0;
        const bool sees =
            look(0, x, outwards, view * places.lattice.spacing.x, [&](const Vector3& y) { return sector->radius(y); });
        is_open[0] |= !sees && radius + places.lattice.spacing.x > edge;
        continue;
      }
      for (std::size_t side = 0; side < 4; ++side) {
        const std::size_t axis = side / 2;
        const int towards = side % 2 == 0 ? -1 : 1;
        const std::int64_t stride = axis == 0 ? 1 : count[0];
        const std::int64_t own = axis == 0 ? n.place % count[0] : n.place / count[0], next = own + towards;
        const bool is_last = next < 0 || next >= count[axis];
        const auto beside = static_cast<std::uint32_t>(n.place + (is_last ? 0 : towards * stride));
        if (!is_last && places.taken[places.number({beside, n.layer})]) continue;
        Vector3 direction;
        direction[static_cast<int>(axis)] = towards;
        const bool sees = look(side, x, direction, view * places.lattice.spacing[static_cast<int>(axis)],
                               [&](const Vector3& y) { return towards * y[static_cast<int>(axis)]; });
        is_open[side] |= !sees && is_last;
      }
    }
  std::vector<std::optional<Sight>> sights;
  for (std::size_t side = 0; side < farthest.size(); ++side)
    sights.push_back(is_open[side] || !std::isfinite(farthest[side].reach) ? std::nullopt
                                                                           : std::optional(farthest[side]));
  return sights;
}

/// Where the wall of a sight ends towards a side, m.
double end_of_wall(const Layout& layout, const Sight& sight, int axis, int towards) {
  const Parameters& p = layout.given;
  const Surface& surface = layout.boundary->vessel();
  const std::size_t part = surface.triangles()[sight.triangle].patch;
  const bool of_file = p.vessel[part].shape == VesselShape::stl;
  const bool is_upright = std::abs(surface.normal(sight.triangle).z) < max_lean;
  double end = -std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < surface.triangles().size(); ++t) {
    const Triangle& triangle = surface.triangles()[t];
    if (surface.part(t) != surface.part(sight.triangle) || (towards * surface.normal(t)[axis] > 0) != sight.along)
      continue;
    std::vector<Vector3> polygon(triangle.corner.begin(), triangle.corner.end());
    if (of_file && is_upright)
      polygon = clipped(clipped(polygon, 2, layout.bottom, 1), 2, layout.bottom + p.bed.height, -1);
    for (const Vector3& x : polygon) end = std::max(end, towards * x[axis]);
  }
  const VesselBounds own = bounds_of(p, part);
  const double bound = towards < 0 ? own.low[axis] : own.high[axis];
  const bool is_whole = std::abs(towards * end - bound) <= (of_file ? of_rounding : of_polygon) * p.bed.spacing;
  return is_whole ? bound : towards * end;
}

/// \pre p has one bed, which keys do not bound alone
std::shared_ptr<const BedWalls> walls_of(const Parameters& p, const std::shared_ptr<const Boundary>& boundary) {
  auto walls = std::make_shared<BedWalls>();
  walls->boundary = boundary, walls->region = p.bed, walls->spacing = p.bed.spacing;
  walls->region.walls = nullptr;
  Parameters q = p;
  q.bed.mass = std::nullopt, q.bed.walls = nullptr;
  const Extent along_x = bed_along_x(q), along_y = bed_along_y(q);
  q.bed.left = along_x.low, q.bed.right = along_x.high, q.bed.front = along_y.low, q.bed.rear = along_y.high;
  const double most = max_places * (sector_of(p) ? sector_of(p)->copies() : 1);
  while (lattice_of(q).positions() > most) q.bed.spacing *= 2;
  const Layout wide(q, boundary);
  VesselPlaces places(wide);
  places.fill();
  const std::vector<std::optional<Sight>> sights = sights_of(places);
  for (std::size_t side = 0; side < 4; ++side)
    if (const auto& sight = sights[sights.size() == 1 ? 0 : side])
      walls->ends[side] = end_of_wall(wide, *sight, side < 2 ? 0 : 1, side % 2 == 0 ? -1 : 1);
  return walls;
}

/// Whether walls may bound a bed where its keys do not.
bool may_have_walls(const BedRegion& bed) {
  return bed.height > 0 && !(bed.left && bed.right && bed.front && bed.rear);
}

}  // namespace

Parameters with_walls_of_beds(Parameters p, const std::shared_ptr<const Boundary>& boundary) {
  if (p.vessel.empty() || p.bed.given) return p;
  const auto region = [&](std::size_t n) -> BedRegion& {
    return n == 0 ? static_cast<BedRegion&>(p.bed) : p.beds[n - 1];
  };
  std::vector<std::size_t> beds;
  for (const std::size_t n : beds_of(p)) {
    const Parameters one = with_bed_alone(p, n);
    if (may_have_walls(one.bed)) beds.push_back(n);
    if (!may_have_walls(one.bed))
      region(n).walls = nullptr;
    else if (!one.bed.walls || !is_of(*one.bed.walls, one, boundary))
      region(n).walls = walls_of(one, boundary);
  }
  if (beds.size() < 2) return p;
  auto widest = region(beds.front()).walls->ends;
  for (const std::size_t n : beds)
    for (std::size_t side = 0; side < 4; ++side) {
      const std::optional<double> end = region(n).walls->ends[side];
      if (!end || !widest[side])
        widest[side] = std::nullopt;
      else
        widest[side] = side % 2 == 0 ? std::min(*end, *widest[side]) : std::max(*end, *widest[side]);
    }
  for (const std::size_t n : beds) {
    auto walls = std::make_shared<BedWalls>(*region(n).walls);
    walls->ends = widest;
    region(n).walls = std::move(walls);
  }
  return p;
}

}  // namespace talus::continuum
