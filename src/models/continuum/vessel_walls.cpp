// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/vessel_walls.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

/// Longest edge of the pieces of the surface, in spacings: the solid angle of a plane is right to 1 % from 0.25 spacings
/// on (WallIntegrals.AreThoseOfAPlane).
constexpr double piece = 0.6;

SumWalls* choose(InstructionSet set) {
  switch (set) {
#if defined(__x86_64__)
    case InstructionSet::avx512:
      return sum_walls_avx512;
    case InstructionSet::avx2:
      return sum_walls_avx2;
#endif
    default:
      return sum_walls_portable;
  }
}

}  // namespace

VesselWalls::VesselWalls(const Surface& surface, double spacing, InstructionSet set)
    : surface_(surface), sum_(choose(set)) {
  if (surface.is_empty()) return;
  points_ = spread_points(surface, piece * spacing);
  for (const SurfacePoint& point : points_) {
    const Vector3 &x = point.place, &n = point.normal;
    places_.push_back(x);
    records_.push_back({{x.x, x.y, x.z}, {n.x, n.y, n.z}, point.area, 0});
  }
  records_.push_back({{1e3, 1e3, 1e3}, {1, 0, 0}, 0, 0});
}

void VesselWalls::find(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length,
                       double skin) {
  first_.assign(position.size() + 1, 0);
  near_.clear();
  if (is_empty() || position.empty()) return;
  const double largest = *std::max_element(smoothing_length.begin(), smoothing_length.end());
  const CellGrid grid(places_, 2 * largest + skin);
  std::vector<std::vector<std::uint32_t>> found((position.size() + chunk_size - 1) / chunk_size);
  team.run(found.size(), [&](std::size_t chunk) {
    std::vector<std::uint32_t>& list = found[chunk];
    for (std::size_t i = chunk * chunk_size; i < std::min(position.size(), (chunk + 1) * chunk_size); ++i) {
      const std::size_t begin = list.size();
      const double reach = 2 * smoothing_length[i] + skin;
      grid.for_each_candidate(position[i], [&](std::uint32_t n) {
        const Vector3 d = places_[n] - position[i];
        if (dot(d, d) <= reach * reach) list.push_back(n);
      });
      std::sort(list.begin() + static_cast<std::ptrdiff_t>(begin), list.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(points_[a].part, a) < std::pair(points_[b].part, b);
      });
      first_[i + 1] = list.size() - begin;
    }
  });
  for (std::size_t i = 0; i < position.size(); ++i) first_[i + 1] += first_[i];
  near_.reserve(first_.back());
  for (const auto& list : found) near_.insert(near_.end(), list.begin(), list.end());
}

void VesselWalls::meet(std::size_t particle, const Vector3& position, double smoothing_length, NearWalls& met) const {
  met.count = 0;
  const std::size_t end = first_[particle + 1];
  for (std::size_t n = first_[particle]; n < end;) {
    const std::uint32_t part = points_[near_[n]].part, patch = points_[near_[n]].patch;
    NearWall wall{.patch = patch, .normal = {}, .sums = {}};
    const std::size_t first = n;
    while (n < end && points_[near_[n]].part == part) ++n;
    if (surface_.is_open(patch)) continue;
    const double place[3] = {position.x, position.y, position.z};
    sum_(records_.data(), near_.data() + first, static_cast<std::uint32_t>(n - first),
         static_cast<std::uint32_t>(points_.size()), place, smoothing_length, wall.sums);
    const Vector3 normal{wall.sums.normal[0], wall.sums.normal[1], wall.sums.normal[2]};
    const double size = norm(normal);
    if (!(size > 0)) continue;
    wall.normal = (1 / size) * normal;
    if (met.count < most_near_walls) {
      met.of[met.count++] = wall;
    } else {
      NearWall& least = *std::min_element(met.of.begin(), met.of.end(), [](const NearWall& a, const NearWall& b) {
        return a.sums.weight < b.sums.weight;
      });
      if (least.sums.weight < wall.sums.weight) least = wall;
    }
  }
}

}  // namespace talus::continuum
