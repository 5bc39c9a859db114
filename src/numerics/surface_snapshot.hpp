// SPDX-License-Identifier: Apache-2.0
/// Values on the triangles of a surface at one time: what files see of the walls of a vessel.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "numerics/grid_snapshot.hpp"

namespace talus {

struct SurfaceSnapshot {
  double time = 0;  ///< s
  std::uint64_t step = 0;
  std::vector<Vector3> points;                         ///< corners, m
  std::vector<std::array<std::int64_t, 3>> triangles;  ///< numbers of their corners
  std::vector<GridSnapshot::Column> columns;           ///< one entry per triangle
};

}  // namespace talus
