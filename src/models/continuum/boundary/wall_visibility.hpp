// SPDX-License-Identifier: Apache-2.0
/// Which points of a vessel's walls a particle sees. What lies behind a nearer wall does not act: the outer face of a
/// sheet that is drawn as a closed solid, a second shell, a wall on the other side of a partition.
///
/// Most particles see all points within their reach, as those inside a convex vessel do. Smooth parts are compared
/// once, when the points are spread: on which side of a part's tangent planes the points of another part lie. A
/// particle on the same side of these planes has nothing of the one part between itself and the other. Only where that
/// does not hold, lines of sight are followed.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/vector.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::continuum {

/// The side of the tangent planes of some points, by their normals, on which something lies.
enum class Side : std::uint8_t { neither = 0, above = 1, below = 2, both = 3 };
constexpr Side operator|(Side a, Side b) {
  return static_cast<Side>(static_cast<int>(a) | static_cast<int>(b));
}

/// The points of one smooth part within the reach of a particle.
struct PointsOfPart {
  std::uint32_t part = 0;
  std::span<std::uint32_t> points;  ///< numbers
  Side side = Side::neither;        ///< of their planes, where the particle is
  Vector3 foot, normal;             ///< the plane that is nearest, its normal towards the particle
  bool above_nearest = false;       ///< whether the particle is above that plane, by the point's own normal
};

class WallVisibility {
 public:
  WallVisibility() = default;
  /// \param surface outlives it \param place, normal, part of all points \param compared how many of them, the last
  /// ones, stand for their parts \param spacing of the particles, m \param reach of a particle of the bed, m
  WallVisibility(const Surface& surface, std::span<const Vector3> place, std::span<const Vector3> normal,
                 std::span<const std::uint32_t> part, std::size_t compared, double spacing, double reach);

  /// Moves the points that the particle at x sees to the front, in their order. \param parts all those within its reach
  /// \param own the number of the part whose points are asked for \returns how many it sees
  std::size_t keep_visible(const Vector3& x, std::span<const PointsOfPart> parts, std::size_t own) const;

 private:
  Side side_of(std::uint32_t part, std::uint32_t other) const;
  bool is_hidden(const Vector3& x, std::uint32_t point, std::span<const std::uint32_t> near, bool all) const;

  const Surface* surface_ = nullptr;
  double spacing_ = 0;
  std::vector<Vector3> seen_at_;  // of each point, a place of the surface
  std::vector<Vector3> normal_;
  std::unordered_map<std::uint64_t, Side> side_;  // of a part, by itself and another one
};

}  // namespace talus::continuum
