// SPDX-License-Identifier: Apache-2.0
#include "analysis/fronts.hpp"

#include <limits>

namespace talus {

std::optional<double> front_position_on_slope(std::span<const Vector3> position, double layer) {
  std::optional<double> front;
  for (const Vector3& x : position)
    if (x.z < layer && (!front || x.x > *front)) front = x.x;
  return front;
}

std::optional<double> front_position(std::span<const Vector3> position) {
  return front_position_on_slope(position, std::numeric_limits<double>::infinity());
}

double front_speed(const Curve& front, double t, double window) {
  return (value_at(front, t) - value_at(front, t - window)) / window;
}

Curve front_speed_curve(const Curve& front, double window, double end) {
  Curve speed;
  if (front.time.empty()) return speed;
  const double start = front.time.front();
  // A window that ends within a billionth of itself after `end` counts.
  for (int n = 1; n * window <= (end - start) + 1e-9 * window; ++n) {
    const double t = start + n * window;
    speed.time.push_back(t);
    speed.value.push_back(front_speed(front, t, window));
  }
  return speed;
}

}  // namespace talus
