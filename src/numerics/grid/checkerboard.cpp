// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/checkerboard.hpp"

#include <algorithm>

namespace talus {

Checkerboard::Checkerboard(std::array<int, 3> count, std::array<bool, 3> periodic)
    : count_(count), periodic_(periodic) {
  const auto nx = static_cast<std::size_t>(count[0]);
  rows_ = static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  stride_ = ((nx + 1) / 2 + 2 + 3) / 4 * 4;
  // Blocks of some 2000 cells: enough work to hand out, and enough blocks for several threads.
  block_ = std::max<std::size_t>(1, 2048 / nx);
  parity_.resize(rows_);
  around_.resize(rows_);
  const auto outside = static_cast<std::uint32_t>(rows_);
  const auto neighbour = [&](int axis, int j, int k, int step) {
    const int n = count_[static_cast<std::size_t>(axis)];
    int& moved = axis == 1 ? j : k;
    moved += step;
    if (moved < 0 || moved >= n) {
      if (!is_periodic(axis)) return outside;
      moved = (moved + n) % n;
    }
    return static_cast<std::uint32_t>(row(j, k));
  };
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j) {
      parity_[row(j, k)] = static_cast<std::uint8_t>((j + k) & 1);
      around_[row(j, k)] = {neighbour(1, j, k, -1), neighbour(1, j, k, 1), neighbour(2, j, k, -1),
                            neighbour(2, j, k, 1)};
    }
}

}  // namespace talus
