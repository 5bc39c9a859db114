// SPDX-License-Identifier: Apache-2.0
/// A triangle of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vector.hpp"

namespace talus {

struct Triangle {
  std::array<Vector3, 3> corner;  ///< m; the normal is to the side from which they are seen counterclockwise
  std::uint32_t patch = 0;        ///< number of the part of the surface that it belongs to

  Vector3 area() const;    ///< area times unit normal, m^2
  Vector3 normal() const;  ///< unit; not finite for a triangle without area
  bool operator==(const Triangle&) const = default;
  Vector3 middle() const { return (1.0 / 3) * (corner[0] + corner[1] + corner[2]); }
};

/// The place of a triangle nearest to x. Source: Ericson, Real-Time Collision Detection (Morgan Kaufmann, 2005), 5.1.5.
Vector3 nearest_place(const Triangle& triangle, const Vector3& x);

/// The fraction of the straight line from a to b at which it crosses the triangle; nothing if it does not. Edges and
/// corners belong to the triangle, neighbours overlap by rounding, and two triangles with a common edge judge it by the
/// same numbers: no line slips through between them. A plane belongs to the side of its normal.
std::optional<double> crossing(const Triangle& triangle, const Vector3& a, const Vector3& b);

}  // namespace talus
