// SPDX-License-Identifier: Apache-2.0
/// The distance tests of kernel.hpp, a register of points at a time. Included by one file for each instruction set; its
/// contents live in that set's namespace.
#pragma once

#include "base/simd.hpp"
#include "numerics/near_points/kernel.hpp"

namespace talus {
inline namespace TALUS_INSTRUCTION_SET {

TALUS_INLINE std::size_t pick_near(const PointBlock* blocks, std::size_t count, std::size_t self, double skin,
                                   std::uint32_t* near) {
  using Number = SimdVector<double>;
  constexpr std::size_t size = PointBlock::size, lanes = Number::lanes;
  const std::size_t own = self / size, place = self % size;
  const Number x = blocks[own].x[place], y = blocks[own].y[place], z = blocks[own].z[place];
  const Number radius = blocks[own].radius[place];
  std::size_t found = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const PointBlock& block = blocks[b];
    unsigned far = b == own ? 1u << place : 0u;
    TALUS_UNROLL for (std::size_t k = 0; k < size; k += lanes) {
      const Number dx = x - Number::load(block.x + k), dy = y - Number::load(block.y + k);
      const Number dz = z - Number::load(block.z + k);
      const Number reach = radius + Number::load(block.radius + k) + skin;
      far |= lane_bits(dx * dx + dy * dy + dz * dz > reach * reach) << k;
    }
    found += registers::pack(block.number, ~far & 0xffu, near + found);
  }
  return found;
}

}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus
