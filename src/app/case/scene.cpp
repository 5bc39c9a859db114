// SPDX-License-Identifier: Apache-2.0
#include "app/case/scene.hpp"

#include <algorithm>

namespace talus::app {

std::vector<WallLine> wall_lines(const Domain& domain) {
  std::vector<WallLine> lines;
  for (const Wall& wall : domain.walls()) {
    const auto at = [&](double s) { return wall.from() + s * wall.direction(); };
    double begin = 0;
    for (const Wall::Opening& opening : wall.openings()) {
      if (opening.begin > begin) lines.push_back({at(begin), at(opening.begin)});
      begin = std::min(opening.end, wall.length());
      if (opening.shut) lines.push_back({at(std::max(0.0, opening.begin)), at(begin), opening.opens_after});
    }
    if (wall.length() > begin) lines.push_back({at(begin), at(wall.length())});
  }
  return lines;
}

Scene scene_of(const Domain& domain, double radius) {
  const Box& box = domain.box();
  Scene scene{.walls = {}, .box = {{box.low, box.high}}, .radius = radius};
  const auto add = [&](int axis, int side, const Vector3& from, const Vector3& to) {
    if (is_mirror(box.face(axis, side))) scene.walls.push_back({from, to});
  };
  const Vector3 &a = box.low, &b = box.high;
  add(2, 0, a, {b.x, a.y, a.z});
  add(2, 1, {a.x, a.y, b.z}, {b.x, a.y, b.z});
  add(0, 0, a, {a.x, a.y, b.z});
  add(0, 1, {b.x, a.y, a.z}, {b.x, a.y, b.z});
  for (const WallLine& line : wall_lines(domain)) scene.walls.push_back(line);
  return scene;
}

}  // namespace talus::app
