// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/vessel_walls.hpp"

#include <algorithm>
#include <cmath>

#include "base/compiled_for.hpp"
#include "numerics/cell_grid.hpp"
#include "physics/sph/wall_integrals.hpp"

namespace talus::continuum {

namespace {

/// Distance of the points of the walls, in spacings: the push of a plane is right to 1 % from 0.4 spacings on, to 7 %
/// from 0.25 on (WallIntegrals.AreThoseOfAPlane).
constexpr double piece = 0.4;
constexpr int steps_of_h = 64;

}  // namespace

VesselWalls::VesselWalls(const Surface& surface, double spacing, InstructionSet set)
    : surface_(surface), sum_(TALUS_COMPILED_FOR(set, sum_walls)) {
  if (surface.is_empty()) return;
  points_ = spread_points(surface, piece * spacing);
  for (const SurfacePoint& point : points_) {
    const Vector3 &x = point.place, &n = point.normal;
    places_.push_back(x);
    records_.push_back({{x.x, x.y, x.z}, {n.x, n.y, n.z}, point.area, 0});
  }
  records_.push_back({{1e3, 1e3, 1e3}, {1, 0, 0}, 0, 0});
  for (int n = 0; n <= 2 * steps_of_h; ++n) plane_.push_back(sph::weight_of_plane(static_cast<double>(n) / steps_of_h));
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
  slot_.assign(position.size(), -1);
  particles_.clear();
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (first_[i] == first_[i + 1]) continue;
    slot_[i] = static_cast<std::int32_t>(particles_.size());
    particles_.push_back(static_cast<std::uint32_t>(i));
  }
  met_.resize(particles_.size());
}

void VesselWalls::meet(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length) {
  for_each(team, particles_.size(), [&](std::size_t n) {
    const std::size_t i = particles_[n];
    meet(i, position[i], smoothing_length[i], met_[n]);
  });
}

double VesselWalls::share_of_plane(double weight, double distance_over_h) const {
  const double place = distance_over_h * steps_of_h;
  if (!(place < 2 * steps_of_h)) return 0;
  const auto n = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(n), whole = (1 - part) * plane_[n] + part * plane_[n + 1];
  return whole > 0 ? std::min(1.0, weight / whole) : 0;
}

void VesselWalls::meet(std::size_t particle, const Vector3& position, double smoothing_length, NearWalls& met) const {
  met.count = 0;
  const std::size_t end = first_[particle + 1];
  for (std::size_t n = first_[particle]; n < end;) {
    const std::uint32_t part = points_[near_[n]].part, patch = points_[near_[n]].patch;
    NearWall wall{.patch = patch, .part = part, .normal = {}, .distance = 0, .share = 0, .sums = {}};
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
    wall.distance = wall.sums.distance / wall.sums.weight;
    wall.share = share_of_plane(wall.sums.weight * smoothing_length, wall.distance / smoothing_length);
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
