// SPDX-License-Identifier: Apache-2.0
#include "analysis/band_loads.hpp"

#include <limits>

#include "analysis/discharge.hpp"

namespace talus {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
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
  BandLoad load{.pressure_at_rest = mean_rate(impulse.normal, -averaging_time, 0),
                .shear_at_rest = mean_rate(impulse.shear, -averaging_time, 0),
                .pressure_in_flow = mean_rate(impulse.normal, from, to),
                .shear_in_flow = mean_rate(impulse.shear, from, to),
                .pressure_largest = none,
                .time_of_largest = none};
  if (impulse.normal.time.empty()) return load;
  const Curve means =
      mean_rates(impulse.normal, peak * averaging_time, peaks_every * averaging_time, 0, impulse.normal.time.back());
  if (means.value.empty()) return load;
  const Extremes found = extremes(means);
  load.pressure_largest = found.largest, load.time_of_largest = found.largest_time;
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
