// SPDX-License-Identifier: Apache-2.0
/// Walls drawn as triangles, as those of an STL file, in m.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {

inline VesselPart drawn(std::string name, std::vector<Triangle> triangles) {
  VesselPart part = named(std::move(name), VesselShape::stl);
  part.unit = FileUnit::m;
  part.drawn = std::make_shared<DrawnSurface>(std::move(triangles));
  return part;
}

/// A sheet with both its faces and its rims: the upper face, a parallelogram at `corner`, lies where the normal of
/// first x second points.
inline std::vector<Triangle> sheet(const Vector3& corner, const Vector3& first, const Vector3& second,
                                   double thickness) {
  const Vector3 normal = cross(first, second), through = (-thickness / norm(normal)) * normal;
  std::array<Vector3, 8> c;
  for (std::size_t n = 0; n < 8; ++n)
    c[n] = corner + double(n & 1) * first + double(n >> 1 & 1) * second + double(n >> 2 & 1) * through;
  constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
  std::vector<Triangle> triangles;
  for (const auto& f : faces) {
    triangles.push_back({{c[f[0]], c[f[1]], c[f[2]]}, 0});
    triangles.push_back({{c[f[0]], c[f[2]], c[f[3]]}, 0});
  }
  return triangles;
}

}  // namespace talus::continuum
