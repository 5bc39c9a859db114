// SPDX-License-Identifier: Apache-2.0
#include "analysis/wall_loads.hpp"

#include "analysis/curve.hpp"
#include "analysis/discharge.hpp"

namespace talus {

namespace {

constexpr std::string_view prefix = "impulse_";

Vector3 change(const Series& series, const std::string& name) {
  Vector3 v;
  for (int axis = 0; axis < 3; ++axis) {
    const auto values = series.column(name + "_" + "xyz"[axis]);
    v[axis] = values.back() - values.front();
  }
  return v;
}

}  // namespace

std::vector<std::string> walls_of(const Series& series) {
  std::vector<std::string> walls;
  for (const std::string& name : series.names) {
    if (!name.starts_with(prefix) || !name.ends_with("_x")) continue;
    const std::string wall = name.substr(prefix.size(), name.size() - prefix.size() - 2);
    if (wall != "gravity" && wall != "damping" && wall != "air") walls.push_back(wall);
  }
  return walls;
}

Vector3 wall_force(const Series& series, std::string_view wall, double from, double to) {
  const std::string name = std::string(prefix) + std::string(wall);
  const auto times = series.column("time");
  Vector3 force;
  for (int axis = 0; axis < 3; ++axis) {
    const auto values = series.column(name + "_" + "xyz"[axis]);
    force[axis] = mean_rate({{times.begin(), times.end()}, {values.begin(), values.end()}}, from, to);
  }
  return force;
}

double weight_balance_error(const Series& series, double weight, double from, double to) {
  double upward = 0;
  for (const std::string& wall : walls_of(series)) upward -= wall_force(series, wall, from, to).z;
  return upward / weight - 1;
}

double momentum_error(const Series& series) {
  const Vector3 gravity = change(series, "impulse_gravity");
  Vector3 given = gravity;
  if (series.has("impulse_damping_x")) given -= change(series, "impulse_damping");
  if (series.has("impulse_air_x")) given += change(series, "impulse_air");
  if (series.has("fed_momentum_x")) given += change(series, "fed_momentum") - change(series, "removed_momentum");
  for (const std::string& wall : walls_of(series)) given -= change(series, std::string(prefix) + wall);
  return norm(change(series, "momentum") - given) / norm(gravity);
}

}  // namespace talus
