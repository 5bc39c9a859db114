// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/fronts.hpp"

namespace talus {

AvalancheRun avalanche_run(const Curve& front, double end, const AvalancheScales& scales) {
  AvalancheRun run{.scales = scales, .end = end / scales.time()};
  const double window = front_speed_window * scales.time();
  run.front_speed = front_speed_curve(front, window, front.time.empty() ? end : std::min(end, front.time.back()));
  for (double& t : run.front_speed.time) t /= scales.time();
  for (double& v : run.front_speed.value) v /= scales.stokes_speed;
  return run;
}

namespace {

// A grain this many initial radii behind the median has left the cloud.
constexpr double leaked_behind = 2;
constexpr double share_in_lateral_radius = 0.9;
constexpr double core = 0.3;

double nth(std::vector<double> values, double share) {
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[static_cast<std::size_t>(n)];
}

}  // namespace

FallingCloud measure_falling_cloud(std::span<const Vector3> position, std::span<const Vector3> velocity,
                                   const Vector3& gravity, double initial_radius) {
  if (position.empty()) throw std::invalid_argument("a cloud without grains");
  std::vector<double> fallen;
  for (const Vector3& x : position) fallen.push_back(dot(x, gravity));
  const double middle = nth(fallen, 0.5);

  std::vector<std::size_t> cloud;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (fallen[i] >= middle - leaked_behind * initial_radius) cloud.push_back(i);
  const double count = static_cast<double>(cloud.size());

  Vector3 centre;
  FallingCloud result;
  for (const std::size_t i : cloud) {
    centre += (1 / count) * position[i];
    result.fall_speed += dot(velocity[i], gravity) / count;
  }
  result.leaked_fraction = 1 - count / static_cast<double>(position.size());

  std::vector<double> lateral;
  double across = 0, along = 0;
  for (const std::size_t i : cloud) {
    const Vector3 d = position[i] - centre;
    const double fall = dot(d, gravity);
    const Vector3 side = d - fall * gravity;
    lateral.push_back(norm(side));
    across += dot(side, side);
    along += fall * fall;
  }
  result.flatness = std::sqrt(across / (2 * along));
  const double radius = nth(lateral, share_in_lateral_radius);
  const auto in_core = std::count_if(lateral.begin(), lateral.end(), [&](double r) { return r < core * radius; });
  result.axial_density = static_cast<double>(in_core) / (share_in_lateral_radius * count * core * core);
  return result;
}

}  // namespace talus
