// SPDX-License-Identifier: Apache-2.0
/// Slabs: where triangles of a surface lie that are nearly in one plane. Who looks at a finely triangulated surface
/// from some distance looks at a few of these.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"

namespace talus {

inline double square_distance_from_box(const Vector3& low, const Vector3& high, const Vector3& x) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = low[axis] - x[axis], above = x[axis] - high[axis];
    const double out = below > 0 ? below : above > 0 ? above : 0;
    sum += out * out;
  }
  return sum;
}

/// Some triangles lie in the box and where |normal x - offset| <= slack.
struct Slab {
  Vector3 low, high;             ///< corners of the box, m
  Vector3 normal;                ///< unit
  double offset = 0, slack = 0;  ///< m
  std::uint32_t patch = 0;

  double height(const Vector3& x) const { return dot(normal, x) - offset; }
  /// No triangle is nearer to x, m.
  double distance(const Vector3& x) const {
    return std::max(std::abs(height(x)) - slack, std::sqrt(square_distance_from_box(low, high, x)));
  }
};

/// Writes the slabs within reach of x, their normals towards it: who is higher than the slack of each, and no farther
/// than the reach, is not hidden from x by what lies in them. \returns whether x is itself higher than each
bool find_half_spaces(const Vector3& x, double reach, std::span<const Slab> slabs, std::vector<Slab>& half_spaces);

}  // namespace talus
