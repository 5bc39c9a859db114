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

/// Cuts every flat piece of the surface into squares of at most `distance`, and takes the middle of what lies in each;
/// rests of less than a third of a square join each other or the nearest square of the same smooth part. So the points
/// are about as many for a surface of any number of triangles of any shape. \param distance > 0, m
std::vector<SurfacePoint> spread_points(const Surface& surface, double distance);

/// The points, by smooth part, in groups of at most four that lie together, each with the point that can stand for it
/// from afar: their middle, their whole area and mean normal.
struct PointGroups {
  std::vector<SurfacePoint> points;
  std::vector<SurfacePoint> whole;       ///< of each group
  std::vector<std::uint32_t> first{0};  ///< point of each group; one more at the end
};

/// \param extent the largest of a group along x, y and z, between its points, m
PointGroups grouped(const std::vector<SurfacePoint>& points, double extent);

}  // namespace talus
