// SPDX-License-Identifier: Apache-2.0
/// The seven-point stencil on a run of cells of one colour, for the sweeps of the pressure solver.
#pragma once

#include <array>
#include <cstddef>

#include "base/registers.hpp"
#include "numerics/grid/checkerboard.hpp"

namespace talus {

/// Values and conductances of the neighbours of one run, m by m.
template <class Number>
struct Runs {
  const Number *west, *east, *south, *north, *below, *above;
  const Number *c_west, *c_east, *c_south, *c_north, *c_below, *c_above;

  /// \param low conductances of low faces, by axis; \param value of all cells; all in the order of the board
  Runs(const Checkerboard& board, const std::array<const Number*, 3>& low, const Number* value, int colour,
       std::size_t r) {
    const int other = 1 - colour;
    const std::size_t own = board.run(colour, r);
    const std::size_t adjacent = board.run(other, r) + static_cast<std::size_t>(board.first(colour, r));
    const auto& around = board.around(r);
    const auto row = [&](std::size_t n) { return board.run(other, around[n]); };
    west = value + adjacent - 1, c_west = low[0] + own;
    east = value + adjacent, c_east = low[0] + adjacent;
    south = value + row(0), c_south = low[1] + own;
    north = value + row(1), c_north = low[1] + row(1);
    below = value + row(2), c_below = low[2] + own;
    above = value + row(3), c_above = low[2] + row(3);
  }

  /// Sum over the neighbours of conductance times value.
  TALUS_INLINE Number inflow(int m) const {
    return ((c_west[m] * west[m] + c_east[m] * east[m]) + (c_south[m] * south[m] + c_north[m] * north[m])) +
           (c_below[m] * below[m] + c_above[m] * above[m]);
  }
  Number conductance(int m) const {
    return ((c_west[m] + c_east[m]) + (c_south[m] + c_north[m])) + (c_below[m] + c_above[m]);
  }
};

}  // namespace talus
