// SPDX-License-Identifier: Apache-2.0
/// Which points of a few blocks are near one of them: what the loop, compiled once for each instruction set, is handed
/// and hands back. All sets find the same points: nothing is fused.
#pragma once

#include <cstddef>
#include <cstdint>

namespace talus {

/// Points in columns, as many as the widest register holds. A place without a point is filled with infinity.
struct alignas(64) PointBlock {
  static constexpr std::size_t size = 8;
  double x[size], y[size], z[size];  ///< m
  double radius[size];               ///< m
  std::uint32_t number[size];
};

/// Boxes around some blocks, in columns: the points of one that is out of reach are not looked at. A place without a
/// block has a box at infinity.
struct alignas(64) BlockBoxes {
  static constexpr std::size_t size = 8;
  double low[3][size], high[3][size];  ///< m
  double radius[size];                 ///< the largest of the block's points, m
  std::uint32_t block[size];
};

/// Writes to `near` the numbers of the points j with |x_i - x_j| <= (a_i + a_j) + skin, without i itself, in the order
/// of the boxes, and returns how many they are. \param boxes, count of the blocks among which j are \param self point
/// i: place self % size of block self / size \param skin in m \param near has room for
/// PointBlock::size numbers for each place of a block in the boxes
using PickNear = std::size_t(const PointBlock* blocks, const BlockBoxes* boxes, std::size_t count, std::size_t self,
                             double skin, std::uint32_t* near);
PickNear pick_near_portable, pick_near_avx2, pick_near_avx512;

}  // namespace talus
