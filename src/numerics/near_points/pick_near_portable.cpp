// SPDX-License-Identifier: Apache-2.0
/// The distance tests, compiled for one instruction set.
#include "numerics/near_points/pick_near.hpp"

namespace talus {

std::size_t pick_near_portable(const PointBlock* blocks, const BlockBoxes* boxes, std::size_t count, std::size_t self,
                               double skin, std::uint32_t* near) {
  return pick_near(blocks, boxes, count, self, skin, near);
}

}  // namespace talus
