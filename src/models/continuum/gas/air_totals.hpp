// SPDX-License-Identifier: Apache-2.0
/// Sums over the cells of the air.
#pragma once

#include <cstddef>

#include "models/continuum/state.hpp"

namespace talus::continuum {

inline constexpr int turns_of_cells = 8;

/// Calls body(cell, turn). Largest numbers and sums over the cells go on in several places in turn, so that one does
/// not wait for the last.
template <class Body>
void for_each_air_cell(const AirAround& air, Body&& body) {
  for (int k = 0; k < air.grid.count[2]; ++k)
    for (int j = 0; j < air.grid.count[1]; ++j) {
      const std::size_t begin = air.grid.index(0, j, k), end = begin + static_cast<std::size_t>(air.grid.count[0]);
      std::size_t c = begin;
      for (; c + turns_of_cells <= end; c += turns_of_cells)
        for (std::size_t n = 0; n < turns_of_cells; ++n) body(c + n, n);
      for (; c < end; ++c) body(c, 0);
    }
}

/// Of all cells of the air, found in one pass.
struct AirTotals {
  double largest_speed = 0;                         ///< m/s
  double least_pressure = 0, largest_pressure = 0;  ///< Pa
  /// Volume that grains have left or taken without air that came or went, m^3: half of the sum over the cells of what
  /// continuity lacks, since what one lacks another has too much.
  double imbalance = 0;
};

AirTotals totals_of_air(const AirAround& air);

}  // namespace talus::continuum
