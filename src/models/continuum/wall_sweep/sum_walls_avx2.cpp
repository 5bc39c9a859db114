// SPDX-License-Identifier: Apache-2.0
/// The sums over the points of a wall, compiled for one instruction set.
#include "models/continuum/wall_sweep/sum_walls.hpp"

namespace talus::continuum {

void sum_walls_avx2(const WallPoint* points, const std::uint32_t* numbers, std::uint32_t count, std::uint32_t padding,
                    const double* position, double h, WallTotals& totals) {
  sum_points(points, numbers, count, padding, position, h, totals);
}

}  // namespace talus::continuum
