// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/wall_fitting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/parallel.hpp"
#include "numerics/neighbourhood.hpp"
#include "numerics/surface/triangle.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

// Lengths in spacings.
constexpr double reach = 2;                      // of the repulsion
constexpr double moves_within = 2.5, fades = 1;  // distance from a wall; from where on less and less
constexpr double gain = 0.08, max_move = 0.1;    // of a sweep
constexpr double max_way = 0.75;                 // from the lattice: beside a free side of a bed there is no balance
constexpr double settled = 0.005;                // the largest move of the last sweep
constexpr double skin = 0.5;                     // of the lists
constexpr int max_sweeps = 60;
constexpr double min_cosine = 0.95;  // of a foot's direction and its triangle's normal: else it is on a rim
constexpr double min_slope = 0.25;   // of the walls that are fitted to, slope_of(): 30 degrees

struct Plane {
  Vector3 foot, normal;  ///< towards the particle
};

/// The square of the sine of its angle with the horizontal.
double slope_of(const Plane& plane) {
  return plane.normal.x * plane.normal.x + plane.normal.y * plane.normal.y;
}

struct WallsNear {
  double distance = std::numeric_limits<double>::infinity();  ///< of the nearest, if it is within that asked for, m
  std::vector<Plane> planes;  ///< of the smooth parts that a particle sees, each at the place nearest to it
};

WallsNear walls_near(const Surface& surface, const Vector3& x, double within) {
  struct Near {
    std::uint32_t triangle;
    Vector3 foot;
    double distance;
  };
  thread_local std::vector<std::uint32_t> triangles;
  for (std::size_t most = 64; triangles.clear(), !surface.near(x, within, most, triangles);) most *= 4;
  std::vector<Near> parts;
  for (const std::uint32_t t : triangles) {
    const Vector3 foot = nearest_place(surface.triangles()[t], x);
    const double distance = norm(x - foot);
    if (!(distance < within)) continue;
    const auto same = std::find_if(parts.begin(), parts.end(),
                                   [&](const Near& other) { return surface.part(other.triangle) == surface.part(t); });
    if (same == parts.end())
      parts.push_back({t, foot, distance});
    else if (distance < same->distance)
      *same = {t, foot, distance};
  }
  WallsNear found;
  for (const Near& near : parts) found.distance = std::min(found.distance, near.distance);
  for (const Near& near : parts) {
    const Vector3 normal = (1 / near.distance) * (x - near.foot);
    const bool is_within = std::abs(dot(normal, surface.normal(near.triangle))) > min_cosine;
    if (!is_within) continue;
    const bool is_nearest = !(near.distance > found.distance);  // nothing stands between
    if (is_nearest || !surface.blocks(x, near.foot + 0.01 * (x - near.foot)))
      found.planes.push_back({near.foot, normal});
  }
  return found;
}

/// Of one on another that is d away; d in spacings. Its potential falls to zero at the reach.
Vector3 repulsion(const Vector3& d) {
  const double square = dot(d, d);  // most are farther away, and need no root
  if (!(square > 0 && square < reach * reach)) return {};
  const double q = std::sqrt(square) / reach, steep = 20 / reach;
  return steep * (1 - q) * (1 - q) * (1 - q) * d;
}

/// What brings a particle as far from the plane as walls hold it, within its level.
Vector3 off_wall(const Plane& plane, const Vector3& x, double spacing) {
  const double missing = sph::contact_distance * spacing - dot(x - plane.foot, plane.normal);
  const double slope = slope_of(plane);
  return missing > 0 && slope > min_slope ? (missing / slope) * Vector3{plane.normal.x, plane.normal.y, 0} : Vector3{};
}

/// What the neighbours and their mirror images in the planes give particle i, and its own image, within its level; of
/// repulsion().
Vector3 push_on(std::size_t i, const std::vector<Vector3>& positions, const Neighbourhood& neighbourhood,
                const std::vector<Plane>& planes, double spacing) {
  const Vector3& x = positions[i];
  Vector3 push;
  for (const Plane& plane : planes) push += repulsion((2 / spacing) * (x - plane.foot));
  for (const std::uint32_t n : neighbourhood.of(i)) {
    const bool is_ghost = n >= positions.size();
    const Ghost ghost = is_ghost ? neighbourhood.ghosts()[n - positions.size()] : Ghost{};
    const Vector3 y = is_ghost ? neighbourhood.image(ghost).position(positions[ghost.source]) : positions[n];
    push += repulsion((1 / spacing) * (x - y));
    for (const Plane& plane : planes) {
      const double above = dot(y - plane.foot, plane.normal);
      if (above > 0) push += repulsion((1 / spacing) * (x - y + (2 * above) * plane.normal));
    }
  }
  push.z = 0;
  return push;
}

/// How much of its push a particle follows: all beside a steep wall, nothing far from them.
double share_of(const Vector3& x, const std::vector<Plane>& planes, double spacing) {
  double distance = moves_within * spacing;
  for (const Plane& plane : planes)
    if (slope_of(plane) > min_slope) distance = std::min(distance, norm(x - plane.foot));
  return std::min((moves_within - distance / spacing) / fades, 1.0);
}

/// A particle that has left through a periodic face or a side of a sector, and where it began with it.
void bring_back(const Domain& domain, Vector3& x, Vector3& began) {
  const Vector3 wrapped = domain.wrap(x);
  began += wrapped - x, x = wrapped;
  if (const std::optional<Image> image = domain.back_into_sector(x))
    x = image->position(x), began = image->position(began);
}

}  // namespace

void fit_to_walls(ThreadTeam& team, const Boundary& boundary, double spacing, std::size_t first,
                  std::vector<Vector3>& positions) {
  const Surface& surface = boundary.vessel();
  const Domain& domain = boundary.domain();
  if (surface.is_empty()) return;
  Neighbourhood neighbourhood(domain, surface);
  const std::size_t count = positions.size();
  const std::vector<double> radius(count, 0.5 * reach * spacing);
  std::vector<Vector3> lattice = positions;
  std::vector<Vector3> next = positions;
  double moved = 0;  // since the lists were built, at most
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    if (sweep == 0 || moved > 0.5 * skin * spacing) {
      for (std::size_t i = 0; i < count; ++i) bring_back(domain, positions[i], lattice[i]);
      neighbourhood.build(team, positions, radius, skin * spacing);
      next = positions, moved = 0;
    }
    /// \returns how far it moves, in spacings
    const auto move_on = [&](std::size_t i) {
      const Vector3 x = positions[i];
      if (neighbourhood.distance_from_vessel(i) > (moves_within + 0.5 * skin) * spacing) return 0.0;
      const auto [nearest, planes] = walls_near(surface, x, moves_within * spacing);
      const double share = share_of(x, planes, spacing);
      if (!(share > 0)) return 0.0;
      Vector3 move = (gain * share) * push_on(i, positions, neighbourhood, planes, spacing);
      if (const double size = norm(move); size > max_move) move = (max_move / size) * move;
      Vector3 to = x + spacing * move;
      for (const Plane& plane : planes) to += off_wall(plane, to, spacing);
      const bool is_far = norm(to - lattice[i]) > max_way * spacing;
      const bool may_cross = !(norm(to - x) < 0.99 * nearest);
      if (is_far || (may_cross && surface.blocks(x, to)) || domain.bounce(x, to)) return 0.0;
      next[i] = to;
      return norm(move);
    };
    const double largest = reduce(
        team, count - first, 0.0, [&](std::size_t n) { return move_on(first + n); },
        [](double a, double b) { return std::max(a, b); });
    moved += largest * spacing;
    positions = next;
    if (largest < settled) break;
  }
  for (std::size_t i = 0; i < count; ++i) bring_back(domain, positions[i], lattice[i]);
}

}  // namespace talus::continuum
