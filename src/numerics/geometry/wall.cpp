// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/wall.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace talus {

double distance_to_segment(const Vector3& x, const Vector3& from, const Vector3& to) {
  const double s = std::clamp(share_of_segment(x, from, to), 0.0, 1.0);
  return std::hypot(x.x - from.x - s * (to.x - from.x), x.z - from.z - s * (to.z - from.z));
}

Wall::Wall(std::string name, const Vector3& from, const Vector3& to, std::vector<Opening> openings)
    : name_(std::move(name)),
      from_(from),
      to_(to),
      openings_(std::move(openings)),
      length_(std::hypot(to.x - from.x, to.z - from.z)) {
  if (!(length_ > 0)) throw std::invalid_argument("a wall has no length");
  const double dx = to.x - from.x, dz = to.z - from.z;
  direction_ = {(1 / length_) * dx, 0, (1 / length_) * dz};
  if (dx == 0) axis_ = 0, direction_ = {0, 0, dz > 0 ? 1.0 : -1.0};
  if (dz == 0) axis_ = 2, direction_ = {dx > 0 ? 1.0 : -1.0, 0, 0};
  normal_ = {0 - direction_.z, 0, direction_.x};
  note_if_gone();
}

void Wall::note_if_gone() {
  is_gone_ = std::any_of(openings_.begin(), openings_.end(),
                         [&](const Opening& o) { return !o.shut && o.begin <= 0 && o.end >= length_; });
}

double Wall::distance(const Vector3& x) const {
  return distance_to_segment(x, from_, to_);
}

bool Wall::has_gates_due(double time) const {
  return std::any_of(openings_.begin(), openings_.end(),
                     [&](const Opening& o) { return o.shut && time >= o.opens_after; });
}

void Wall::open_gates(double time) {
  for (Opening& opening : openings_) opening.shut = opening.shut && time < opening.opens_after;
  note_if_gone();
}

}  // namespace talus
