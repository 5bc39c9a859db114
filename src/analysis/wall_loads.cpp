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

namespace {

constexpr double peak = 0.5, peaks_every = 0.05, curve_every = 0.25;  // of the averaging time

/// The impulse over the area against the time from the gate's opening, Pa s.
Curve specific(const Series& series, const std::string& column, double area, double gate_time) {
  Curve curve;
  if (!series.has(column)) return curve;
  const auto time = series.column("time"), value = series.column(column);
  for (std::size_t n = 0; n < time.size(); ++n) {
    curve.time.push_back(time[n] - gate_time);
    curve.value.push_back(value[n] / area);
  }
  return curve;
}

struct Specific {
  Curve normal, shear;
  Specific(const Series& series, const BandOfWall& band, double gate_time)
      : normal(specific(series, "normal_impulse_" + band.name, band.area, gate_time)),
        shear(specific(series, "shear_impulse_" + band.name, band.area, gate_time)) {}
};

}  // namespace

BandLoad load_of(const Series& series, const BandOfWall& band, double gate_time, double from, double to,
                 double averaging_time) {
  const Specific impulse(series, band, gate_time);
  const double there = to - from - (band.gate ? band.gate->time_away(from, to) : 0);
  const auto in_flow = [&](const Curve& curve) {
    if (there == to - from) return mean_rate(curve, from, to);
    return there > 0 ? mean_rate(curve, from, to) * (to - from) / there : no_value;
  };
  BandLoad load{.pressure_at_rest = mean_rate(impulse.normal, -averaging_time, 0),
                .shear_at_rest = mean_rate(impulse.shear, -averaging_time, 0),
                .pressure_in_flow = in_flow(impulse.normal),
                .shear_in_flow = in_flow(impulse.shear),
                .pressure_largest = no_value,
                .time_of_largest = no_value};
  if (impulse.normal.time.empty()) return load;
  const Curve means =
      mean_rates(impulse.normal, peak * averaging_time, peaks_every * averaging_time, 0, impulse.normal.time.back());
  if (means.value.empty()) return load;
  const Extremes found = extremes(means);
  load.pressure_largest = found.max, load.time_of_largest = found.max_time;
  return load;
}

BandCurves curves_of(const Series& series, const BandOfWall& band, double gate_time, double averaging_time) {
  const Specific impulse(series, band, gate_time);
  const auto means = [&](const Curve& curve) {
    return curve.time.empty() ? Curve{}
                              : mean_rates(curve, peak * averaging_time, curve_every * averaging_time,
                                           curve.time.front(), curve.time.back());
  };
  return {means(impulse.normal), means(impulse.shear)};
}

}  // namespace talus
