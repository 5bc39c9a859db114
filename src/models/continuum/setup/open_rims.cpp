// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/bed_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "models/continuum/setup/layout.hpp"
#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

constexpr double probe = 0.6, sideways = 0.9, near = 1.2, deep = 1, min_length = 2;  // in spacings
constexpr double max_positions_of_rims = 2e5;  // of a lattice; a coarser one reports holes that matter as well

/// A place on a rim.
struct Sample {
  Vector3 place, normal;  ///< the normal is that of the triangle
  Vector3 half;           ///< along the rim, of what it stands for, m
};

struct Candidate {
  std::size_t part;
  Rim rim;
  std::vector<Sample> open;  ///< around which there is a way
  double length = 0;         ///< of all of the rim, m
};

bool is_closed(const Parameters& p, const Vector3& x) {
  const auto beyond = [](double c, double extent, FaceKind low, FaceKind high) {
    return (c <= 0 && low != FaceKind::open) || (c >= extent && high != FaceKind::open);
  };
  return beyond(x.x, p.box.width, p.box.left, p.box.right) || beyond(x.y, p.box.depth, p.box.front, p.box.rear) ||
         beyond(x.z, p.box.height, p.box.floor, p.box.top);
}

/// Whether a grain comes from one side of the triangle around its edge to the other.
bool is_way_around(const Parameters& p, const Surface& surface, const Domain& domain, const Vector3& x,
                   const Vector3& normal, const Vector3& outwards) {
  const Vector3 n = 0.5 * probe * p.bed.spacing * normal, out = probe * p.bed.spacing * outwards;
  const std::array<Vector3, 4> way = {x - out + n, x + out + n, x + out - n, x - out - n};
  for (std::size_t k = 0; k < way.size(); ++k)
    if (is_closed(p, way[k]) || (k > 0 && (surface.blocks(way[k - 1], way[k]) || domain.blocks(way[k - 1], way[k]))))
      return false;
  return true;
}

Candidate candidate_of(const Parameters& p, const Surface& surface, const Domain& domain, std::size_t part,
                       std::span<const Triangle> triangles, Rim rim, double top) {
  Candidate candidate{part, std::move(rim), {}};
  const std::vector<Vector3>& corners = candidate.rim.corners;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Vector3 &a = corners[n], edge = corners[(n + 1) % corners.size()] - a;
    const Triangle& t = triangles[candidate.rim.triangles[n]];
    const double length = norm(edge), pieces = std::max(1.0, std::ceil(length / p.bed.spacing));
    candidate.length += length;
    const Vector3 normal = t.normal();
    Vector3 outwards = (1 / length) * cross(edge, normal);
    if (dot(outwards, t.middle() - a) > 0) outwards = -1.0 * outwards;
    for (double k = 0.5; k < pieces; ++k) {
      const Vector3 x = a + (k / pieces) * edge;
      if (x.z < top - deep * p.bed.spacing && is_way_around(p, surface, domain, x, normal, outwards))
        candidate.open.push_back({x, normal, (0.5 / pieces) * edge});
    }
  }
  return candidate;
}

/// Triangles from the middle of a rim to its edges.
std::vector<Triangle> cap_of(const Rim& rim) {
  Vector3 middle;
  for (const Vector3& x : rim.corners) middle += (1.0 / static_cast<double>(rim.corners.size())) * x;
  std::vector<Triangle> cap;
  for (std::size_t n = 0; n < rim.corners.size(); ++n)
    cap.push_back({{rim.corners[n], rim.corners[(n + 1) % rim.corners.size()], middle}, 0});
  return cap;
}

/// Where the bed would lie if these rims were closed.
std::vector<Vector3> bed_behind(const Parameters& p, const std::vector<Candidate>& candidates) {
  std::vector<Triangle> caps;
  for (const Candidate& candidate : candidates) {
    const std::vector<Triangle> cap = cap_of(candidate.rim);
    caps.insert(caps.end(), cap.begin(), cap.end());
  }
  Parameters closed = p;
  VesselPart part;
  part.name = "caps", part.shape = VesselShape::stl, part.unit = FileUnit::m;
  part.drawn = std::make_shared<DrawnSurface>(std::move(caps));
  if (!part.drawn->triangles().empty()) closed.vessel.push_back(std::move(part));
  return bed_positions(Layout(closed));
}

}  // namespace

std::vector<OpenRim> rims_below_bed(const Layout& of_case) {
  const bool any = std::any_of(of_case.given.vessel.begin(), of_case.given.vessel.end(),
                               [](const VesselPart& v) { return v.shape == VesselShape::stl && !v.gate; });
  if (!any) return {};
  Parameters coarse = of_case.given;
  while (lattice_of(coarse).positions() > max_positions_of_rims) coarse.bed.spacing *= 2;
  const Layout layout = coarse.bed.spacing > of_case.given.bed.spacing ? Layout(coarse) : of_case;
  const Parameters& p = layout.given;
  double top = 0;
  for (const std::size_t n : beds_of(p)) {
    const Parameters one = with_bed_alone(p, n);
    top = std::max(top, bed_bottom(one) + one.bed.height);
  }
  const Surface& surface = layout.boundary->vessel();
  const Domain& domain = layout.boundary->domain();
  std::vector<Candidate> candidates;
  for (std::size_t part = 0; part < p.vessel.size(); ++part) {
    if (p.vessel[part].shape != VesselShape::stl || p.vessel[part].gate) continue;
    const std::vector<Triangle> triangles = placed_triangles(p.vessel[part]);
    for (Rim& rim : placed_rims(p.vessel[part]))
      if (Candidate c = candidate_of(p, surface, domain, part, triangles, std::move(rim), top); !c.open.empty())
        candidates.push_back(std::move(c));
  }
  if (candidates.empty()) return {};
  const std::vector<Vector3> bed = bed_behind(p, candidates);
  if (bed.empty()) return {};
  const double reach = near * p.bed.spacing;
  const CellGrid grid(bed, reach);
  const auto has_grains = [&](const Vector3& x) {
    bool found = false;
    grid.for_each_candidate(x, [&](std::uint32_t n) { found = found || norm(bed[n] - x) <= reach; });
    return found;
  };
  std::vector<OpenRim> rims;
  for (const Candidate& candidate : candidates) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vector3 low{infinity, infinity, infinity}, high = -1.0 * low;
    double length = 0;
    for (const Sample& sample : candidate.open) {
      const Vector3 side = sideways * p.bed.spacing * sample.normal;
      if (has_grains(sample.place + side) == has_grains(sample.place - side)) continue;
      length += 2 * norm(sample.half);
      for (const Vector3& end : {sample.place - sample.half, sample.place + sample.half})
        for (int axis = 0; axis < 3; ++axis)
          low[axis] = std::min(low[axis], end[axis]), high[axis] = std::max(high[axis], end[axis]);
    }
    if (length < std::min(min_length * p.bed.spacing, 0.5 * candidate.length)) continue;
    std::array<double, 3> extent = {high.x - low.x, high.y - low.y, high.z - low.z};
    std::sort(extent.begin(), extent.end());
    rims.push_back({candidate.part, 0.5 * (low + high), extent[2], extent[1]});
  }
  return rims;
}

}  // namespace talus::continuum
