// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/section.hpp"

namespace talus {

std::vector<std::array<Vector3, 2>> section_at(const Surface& surface, double y) {
  std::vector<std::array<Vector3, 2>> lines;
  for (const Triangle& t : surface.triangles()) {
    if (surface.is_open(t.patch)) continue;
    std::array<Vector3, 2> ends;
    std::size_t count = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3 &a = t.corner[c], &b = t.corner[(c + 1) % 3];
      if ((a.y >= y) != (b.y >= y)) ends[count++] = a + ((y - a.y) / (b.y - a.y)) * (b - a);
    }
    if (count == 2) lines.push_back(ends);
  }
  return lines;
}

}  // namespace talus
