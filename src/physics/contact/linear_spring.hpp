// SPDX-License-Identifier: Apache-2.0
/// Elastic repulsion of overlapping spheres, without friction or damping.
/// Source: Niiya, Awazu & Nishimori 2020, Eqs 2a-2c.
#pragma once

#include "base/vector.hpp"

namespace talus::contact {

/// Overlap of two spheres, Eq. 2c; negative: a gap.
/// \param radius_i, radius_j, distance of the centres, m
constexpr double overlap(double radius_i, double radius_j, double distance) {
  return radius_i + radius_j - distance;
}

/// Overlap of a sphere with the slope z = 0 on which it rests; negative: a gap. The paper: "we calculate the overlap
/// distance between them".
constexpr double slope_overlap(double radius, double z) {
  return radius - z;
}

/// Size of the repulsive force, Eq. 2b: stiffness times overlap, none across a gap.
/// \param stiffness N/m; \param overlap m; \returns N, >= 0
constexpr double linear_spring(double stiffness, double overlap) {
  return overlap > 0 ? stiffness * overlap : 0.0;
}

/// Force on i from j, Eq. 2a. Eq. 2a's unit vector points from i to j and Eq. 2b's force is negative: i is pushed away
/// from j.
/// \param offset r_j - r_i, m; two centres in one point have no direction: the force is then not finite
inline Vector3 repulsion(double stiffness, double radius_i, double radius_j, const Vector3& offset) {
  const double distance = norm(offset);
  const double force = linear_spring(stiffness, overlap(radius_i, radius_j, distance));
  return force > 0 ? (-force / distance) * offset : Vector3{};
}

}  // namespace talus::contact
