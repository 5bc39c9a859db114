// SPDX-License-Identifier: Apache-2.0
/// Points spread over a surface, for integrals over it.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "numerics/surface/surface.hpp"

namespace talus {

struct SurfacePoint {
  Vector3 place;   ///< m
  Vector3 normal;  ///< unit
  double area;     ///< that it stands for, m^2
  std::uint32_t patch, part;
};

/// Cuts triangles across their longest edges until none is longer than `edge`, and takes their middles; triangles that
/// are smaller than half of that are gathered by cells of that size, so that the points are about as many for a surface
/// of any number of triangles. \param edge > 0, m
std::vector<SurfacePoint> spread_points(const Surface& surface, double edge);

}  // namespace talus
