// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/slab.hpp"

namespace talus {

bool find_half_spaces(const Vector3& x, double reach, std::span<const Slab> slabs, std::vector<Slab>& half_spaces) {
  constexpr double rounding = 1e-8;  // of heights, over the reach
  half_spaces.clear();
  for (Slab slab : slabs) {
    if (slab.distance(x) > reach) continue;
    slab.slack += rounding * reach;
    const double height = slab.height(x);
    if (std::abs(height) <= slab.slack) return false;
    if (height < 0) slab.normal = -1.0 * slab.normal, slab.offset = -slab.offset;
    half_spaces.push_back(slab);
  }
  return true;
}

}  // namespace talus
