// SPDX-License-Identifier: Apache-2.0
/// The distance tests of kernel.hpp, a register of points at a time. Compiled once for each instruction set.
#include "base/simd.hpp"
#include "numerics/near_points/kernel.hpp"

namespace talus {

std::size_t TALUS_FOR_SET(pick_near)(const PointBlock* blocks, const BlockBoxes* boxes, std::size_t count,
                                     std::size_t self, double skin, std::uint32_t* near) {
  using Number = SimdVector<double>;
  constexpr std::size_t size = PointBlock::size, lanes = Number::lanes;
  constexpr unsigned all = (1u << size) - 1;
  static_assert(BlockBoxes::size == size);
  constexpr double rounding = 1 - 1e-9;  // of the distance from a box
  const std::size_t own = self / size, place = self % size;
  const Number x = blocks[own].x[place], y = blocks[own].y[place], z = blocks[own].z[place];
  const Number radius = blocks[own].radius[place];
  // The blocks within reach first, without a branch for each: at the end of what has room for all points, where a block
  // is read before points are written over it.
  std::uint32_t* const within = near + (size - 1) * BlockBoxes::size * count;
  std::size_t blocks_within = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const BlockBoxes& box = boxes[b];
    unsigned out = 0;
    TALUS_UNROLL for (std::size_t k = 0; k < size; k += lanes) {
      const auto gap = [&](const Number& at, int axis) {
        const Number below = Number::load(box.low[axis] + k) - at, above = at - Number::load(box.high[axis] + k);
        return maximum(maximum(below, above), Number(0.0));
      };
      const Number dx = gap(x, 0), dy = gap(y, 1), dz = gap(z, 2);
      const Number reach = radius + Number::load(box.radius + k) + skin;
      out |= lane_bits(rounding * (dx * dx + dy * dy + dz * dz) > reach * reach) << k;
    }
    blocks_within += registers::pack(box.block, ~out & all, within + blocks_within);
  }
  std::size_t found = 0;
  for (std::size_t b = 0; b < blocks_within; ++b) {
    const PointBlock& block = blocks[within[b]];
    unsigned far = within[b] == own ? 1u << place : 0u;
    TALUS_UNROLL for (std::size_t k = 0; k < size; k += lanes) {
      const Number dx = x - Number::load(block.x + k), dy = y - Number::load(block.y + k);
      const Number dz = z - Number::load(block.z + k);
      const Number reach = radius + Number::load(block.radius + k) + skin;
      far |= lane_bits(dx * dx + dy * dy + dz * dz > reach * reach) << k;
    }
    found += registers::pack(block.number, ~far & all, near + found);
  }
  return found;
}

}  // namespace talus
