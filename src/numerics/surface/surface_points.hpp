// SPDX-License-Identifier: Apache-2.0
/// Points spread over a surface, for integrals over it.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/sector.hpp"
#include "numerics/surface/surface.hpp"

namespace talus {

struct SurfacePoint {
  Vector3 place;   ///< m
  Vector3 normal;  ///< unit
  double area;     ///< that it stands for, m^2
  std::uint32_t patch, part;
};

/// Cuts every flat piece of the surface into squares of at most `distance`, and takes the middle of what lies in each;
/// rests of less than a third of a square join each other or the nearest square of the same smooth part. So the points
/// are about as many for a surface of any number of triangles of any shape. \param distance > 0, m
std::vector<SurfacePoint> spread_points(const Surface& surface, double distance);

/// The points of what of the surface is in a sector, and then those of each of its copies, in the same order: as
/// symmetric as the surface. \param surface whose triangles, and so its smooth parts, turn into each other by the angle
/// of the sector
std::vector<SurfacePoint> spread_points(const Surface& surface, double distance, const Sector& sector);

}  // namespace talus
