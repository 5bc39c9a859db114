// SPDX-License-Identifier: Apache-2.0
/// The sums over the points of a wall, a register of points at a time. Included by one file for each instruction set;
/// its contents live in that set's namespace.
#pragma once

#include "base/simd.hpp"
#include "models/continuum/wall_sweep/kernel.hpp"
#include "physics/sph/wall_integrals.hpp"

namespace talus::continuum {
inline namespace TALUS_INSTRUCTION_SET {

TALUS_INLINE void sum_points(const WallPoint* points, const std::uint32_t* numbers, std::uint32_t count,
                             std::uint32_t padding, const double* position, double h, WallTotals& totals) {
  using Number = SimdVector<double>;
  sph::WallSums<Number> sums;
  for (std::uint32_t first = 0; first < count; first += Number::lanes) {
    Number column[8];
    load_columns(
        [&](int lane) {
          const std::uint32_t n = first + static_cast<std::uint32_t>(lane);
          return points[n < count ? numbers[n] : padding].place;
        },
        column);
    const Number d[3] = {column[0] - Number(position[0]), column[1] - Number(position[1]),
                         column[2] - Number(position[2])};
    const Number n[3] = {column[3], column[4], column[5]};
    sums.add(d, n, column[6], h);
  }
  totals.density = sum_lanes(sums.density, 0);
  for (int a = 0; a < 3; ++a) {
    totals.slope[a] = sum_lanes(sums.slope[a], 0);
    totals.closing[a] = sum_lanes(sums.closing[a], 0);
    totals.normal[a] = sum_lanes(sums.normal[a], 0);
  }
  for (int c = 0; c < 6; ++c) totals.moment[c] = sum_lanes(sums.moment[c], 0);
  totals.nearness = sum_lanes(sums.nearness, 0);
  totals.weight = sum_lanes(sums.weight, 0);
  totals.distance = sum_lanes(sums.distance, 0);
}

}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus::continuum
