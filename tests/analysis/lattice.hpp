// SPDX-License-Identifier: Apache-2.0
/// Grains placed by hand, for the tests of the analysis.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "base/vector.hpp"

namespace talus::test {

using Points = std::vector<Vector3>;

inline void append(Points& points, const Points& more) {
  points.insert(points.end(), more.begin(), more.end());
}

/// A square lattice in the plane x, y: nx times ny points from `corner` on.
inline Points block(Vector3 corner, int nx, int ny, double spacing) {
  Points points;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) points.push_back(corner + Vector3{i * spacing, j * spacing, 0});
  return points;
}

/// A bow of unit grains, 2 apart: 4 layers from x = -6 to 0, `columns` columns around y = centre, and behind its
/// outermost three columns on each side two legs of 4 more layers. Width 2 `columns`, thickness 8; the legs end 8
/// behind the centre.
inline Points bow(double centre, int columns) {
  Points points = block({-6, centre - (columns - 1), 0}, 4, columns, 2);
  append(points, block({-14, centre - (columns - 1), 0}, 4, 3, 2));
  append(points, block({-14, centre + (columns - 1) - 4, 0}, 4, 3, 2));
  return points;
}
inline std::size_t grains_of_bow(int columns) {
  return static_cast<std::size_t>(4 * columns + 24);
}

inline Points random_disc(std::size_t count, double radius, std::uint64_t seed) {
  Random random(seed);
  Points points;
  while (points.size() < count) {
    const Vector3 x{random.uniform(-radius, radius), random.uniform(-radius, radius), 0};
    if (norm(x) < radius) points.push_back(x);
  }
  return points;
}

}  // namespace talus::test
