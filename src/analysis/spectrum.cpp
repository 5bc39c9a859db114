// SPDX-License-Identifier: Apache-2.0
#include "analysis/spectrum.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "analysis/discharge.hpp"
#include "analysis/statistics.hpp"

namespace talus {

Curve at_equal_times(const Curve& curve, double rate, double from, double to) {
  Curve equal;
  if (!covers(curve, from, to)) return equal;
  const auto last = static_cast<std::size_t>(std::floor((to - from) * rate * (1 + 1e-9)));
  for (std::size_t n = 0; n <= last; ++n) {
    equal.time.push_back(from + static_cast<double>(n) / rate);
    equal.value.push_back(value_at(curve, equal.time.back()));
  }
  return equal;
}

Curve power_spectrum(const Curve& curve, double least, double most) {
  const std::size_t count = curve.time.size();
  if (count < 4) throw std::invalid_argument("a spectrum needs four data");
  const double n = static_cast<double>(count);
  const double interval = (curve.time.back() - curve.time.front()) / (n - 1);
  const Line line = fit_line(curve.time, curve.value);
  std::vector<double> tapered;
  double window_sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double window = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / n);
    window_sum += window;
    tapered.push_back(window * (curve.value[k] - line.intercept - line.slope * curve.time[k]));
  }

  Curve power;
  const double step = 1 / (4 * n * interval);
  for (double multiple = std::ceil(least / step); multiple * step <= most; ++multiple) {
    const double frequency = multiple * step;
    double even = 0, odd = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double phase = 2 * std::numbers::pi * frequency * interval * static_cast<double>(k);
      even += tapered[k] * std::cos(phase);
      odd += tapered[k] * std::sin(phase);
    }
    power.time.push_back(frequency);
    power.value.push_back((even * even + odd * odd) / (window_sum * window_sum));
  }
  return power;
}

double dominant_period(const Curve& curve, double shortest, double longest) {
  double period = std::numeric_limits<double>::quiet_NaN(), highest = 0;
  if (curve.time.size() < 4) return period;
  const Curve power = power_spectrum(curve, 1 / longest, 1 / shortest);
  for (std::size_t k = 1; k + 1 < power.value.size(); ++k)
    if (power.value[k] > highest && power.value[k] > power.value[k - 1] && power.value[k] >= power.value[k + 1]) {
      highest = power.value[k];
      period = 1 / power.time[k];
    }
  return period;
}

double crossing_period(const Curve& curve) {
  double begin = 0, end = 0, crossings = 0;
  for (std::size_t n = 1; n < curve.time.size(); ++n) {
    const double before = curve.value[n - 1], now = curve.value[n];
    if (!(before < 0 && now >= 0)) continue;
    end = std::lerp(curve.time[n - 1], curve.time[n], before / (before - now));
    if (crossings++ == 0) begin = end;
  }
  return crossings > 1 ? (end - begin) / (crossings - 1) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace talus
