// SPDX-License-Identifier: Apache-2.0
/// What the sums over the points of a wall, compiled once for each instruction set, are handed and hand back.
#pragma once

#include <cstdint>

namespace talus::continuum {

/// A point of a wall.
struct alignas(64) WallPoint {
  double place[3];   ///< m
  double normal[3];  ///< unit
  double area;       ///< m^2
  double unused;
};

/// sph::WallSums, in its order.
struct WallTotals {
  double density = 0;
  double slope[3] = {}, moment[6] = {}, closing[3] = {}, normal[3] = {};
  double nearness = 0, weight = 0, distance = 0;
};

/// \param numbers of the `count` points; \param padding number of a point without area, which fills up registers
/// \param position of the particle, m; \param h its smoothing length, m
using SumWalls = void(const WallPoint* points, const std::uint32_t* numbers, std::uint32_t count, std::uint32_t padding,
                      const double* position, double h, WallTotals& totals);
SumWalls sum_walls_portable, sum_walls_avx2, sum_walls_avx512;

}  // namespace talus::continuum
