// SPDX-License-Identifier: Apache-2.0
/// Surfaces for the tests.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "numerics/surface/triangle.hpp"

namespace talus {

/// A ball of radius 1: an octahedron whose triangles are halved and blown up; normals outwards.
inline std::vector<Triangle> ball(int halvings) {
  const Vector3 c[6] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles;
  for (int n = 0; n < 4; ++n) {
    triangles.push_back({{c[n], c[(n + 1) % 4], c[4]}, 0});
    triangles.push_back({{c[(n + 1) % 4], c[n], c[5]}, 0});
  }
  const auto middle = [](const Vector3& a, const Vector3& b) {
    const Vector3 m = a + b;
    return (1 / norm(m)) * m;
  };
  for (int k = 0; k < halvings; ++k) {
    std::vector<Triangle> finer;
    for (const Triangle& t : triangles) {
      const auto& [a, b, d] = t.corner;
      const Vector3 ab = middle(a, b), bd = middle(b, d), da = middle(d, a);
      for (const Triangle& part :
           {Triangle{{a, ab, da}, 0}, Triangle{{ab, b, bd}, 0}, Triangle{{da, bd, d}, 0}, Triangle{{ab, bd, da}, 0}})
        finer.push_back(part);
    }
    triangles = finer;
  }
  return triangles;
}

/// An upright tube of radius 1 from z = 0 to 4, normals inwards.
inline std::vector<Triangle> tube(int sides) {
  std::vector<Triangle> triangles;
  const auto at = [&](int n, double z) {
    const double angle = 2 * std::numbers::pi * (n % sides) / sides;
    return Vector3{std::cos(angle), std::sin(angle), z};
  };
  for (int n = 0; n < sides; ++n) {
    triangles.push_back({{at(n, 0), at(n, 4), at(n + 1, 0)}, 0});
    triangles.push_back({{at(n + 1, 0), at(n, 4), at(n + 1, 4)}, 0});
  }
  return triangles;
}

/// A square in the plane z = 0 from -size to size.
inline std::vector<Triangle> square(double size) {
  const Vector3 a{-size, -size, 0}, b{size, -size, 0}, c{size, size, 0}, d{-size, size, 0};
  return {{{a, b, c}, 0}, {{a, c, d}, 0}};
}

}  // namespace talus
