// SPDX-License-Identifier: Apache-2.0
/// Rows of a fine board and of a coarse one whose cells join them, 1 or 2 along each axis.
#pragma once

#include <algorithm>
#include <array>

#include "numerics/grid/checkerboard.hpp"

namespace talus {

/// Calls body(fine row, whether it is the lowest along y, along z) for the fine rows of a coarse row.
template <class Body>
void for_each_joined_row(const Checkerboard& fine, const Checkerboard& coarse, const std::array<int, 3>& factor,
                         std::size_t coarse_row, Body&& body) {
  const int J = static_cast<int>(coarse_row) % coarse.count()[1], K = static_cast<int>(coarse_row) / coarse.count()[1];
  const int j_end = std::min((J + 1) * factor[1], fine.count()[1]),
            k_end = std::min((K + 1) * factor[2], fine.count()[2]);
  for (int k = K * factor[2]; k < k_end; ++k)
    for (int j = J * factor[1]; j < j_end; ++j) body(fine.row(j, k), j == J * factor[1], k == K * factor[2]);
}

/// The coarse row of a fine one.
inline std::size_t joining_row(const Checkerboard& fine, const Checkerboard& coarse, const std::array<int, 3>& factor,
                               std::size_t fine_row) {
  const int j = static_cast<int>(fine_row) % fine.count()[1], k = static_cast<int>(fine_row) / fine.count()[1];
  return coarse.row(j / factor[1], k / factor[2]);
}

}  // namespace talus
