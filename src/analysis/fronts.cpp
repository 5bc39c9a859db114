// SPDX-License-Identifier: Apache-2.0
#include "analysis/fronts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

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

namespace {

constexpr double cluster_reach = 4, step = 3;  // mean radii

/// The grain to go to from i, or nothing.
std::optional<std::uint32_t> next_grain(std::span<const Vector3> position, const Links& links,
                                        const std::vector<bool>& closed, std::uint32_t i) {
  std::optional<std::uint32_t> next;
  std::tuple<double, double> least;
  for (const std::uint32_t j : links.of(i)) {
    const Vector3 d = position[j] - position[i];
    if (closed[j] || d.z < 0) continue;
    const std::tuple order{std::atan2(d.z, d.x), dot(d, d)};
    if (!next || order < least) {
      next = j;
      least = order;
    }
  }
  return next;
}

}  // namespace

GrainSet surface_walk(std::span<const Vector3> position, double mean_radius) {
  const Links wide(position, cluster_reach * mean_radius);
  const GrainSet cluster = max_set(wide.connected_sets(std::vector<bool>(position.size(), true)), position);
  if (cluster.empty()) return {};
  const Links links(position, step * mean_radius);

  std::vector<bool> closed(position.size(), true);
  std::uint32_t foremost = cluster.front();
  for (const std::uint32_t i : cluster) {
    closed[i] = false;
    if (std::tuple(position[i].x, -position[i].z) > std::tuple(position[foremost].x, -position[foremost].z))
      foremost = i;
  }

  GrainSet path = {foremost};
  closed[foremost] = true;
  while (const auto next = next_grain(position, links, closed, path.back())) {
    closed[*next] = true;
    path.push_back(*next);
  }
  return path;
}

std::optional<double> angle_of_line(std::span<const Vector3> position, const GrainSet& grains) {
  if (grains.size() < 3) return std::nullopt;
  Vector3 centre;
  for (const std::uint32_t i : grains) centre += 1.0 / static_cast<double>(grains.size()) * position[i];
  double xx = 0, xz = 0, zz = 0;
  for (const std::uint32_t i : grains) {
    const Vector3 d = position[i] - centre;
    xx += d.x * d.x;
    xz += d.x * d.z;
    zz += d.z * d.z;
  }
  if (xz == 0 && xx == zz) return std::nullopt;
  // Direction of the largest moment, from +x, in (-pi/2, pi/2].
  const double direction = 0.5 * std::atan2(2 * xz, xx - zz);
  return direction > 0 ? std::numbers::pi - direction : -direction;
}

}  // namespace talus
