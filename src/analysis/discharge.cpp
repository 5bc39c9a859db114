// SPDX-License-Identifier: Apache-2.0
#include "analysis/discharge.hpp"

#include <cmath>
#include <limits>

#include "analysis/statistics.hpp"

namespace talus {

namespace {
constexpr double none = std::numeric_limits<double>::quiet_NaN();
}

Curve integral(const Curve& curve) {
  Curve sum{curve.time, std::vector<double>(curve.time.size(), 0.0)};
  for (std::size_t n = 1; n < curve.time.size(); ++n)
    sum.value[n] = sum.value[n - 1] + 0.5 * (curve.value[n] + curve.value[n - 1]) * (curve.time[n] - curve.time[n - 1]);
  return sum;
}

Curve scaled(const Curve& curve, double factor, double constant) {
  Curve result = curve;
  for (double& value : result.value) value = constant + factor * value;
  return result;
}

bool covers(const Curve& curve, double from, double to) {
  const auto rounding = [](double t) { return 1e-9 * std::abs(t); };
  return !curve.time.empty() && curve.time.front() <= from + rounding(from) && to - rounding(to) <= curve.time.back();
}

double mean_rate(const Curve& cumulative, double from, double to) {
  if (!covers(cumulative, from, to) || !(to > from)) return none;
  return (value_at(cumulative, to) - value_at(cumulative, from)) / (to - from);
}

Curve mean_rates(const Curve& cumulative, double length, double every, double from, double to) {
  Curve means;
  for (std::size_t n = 0;; ++n) {
    const double start = from + static_cast<double>(n) * every, end = start + length;
    if (end > to + 1e-9 * std::abs(to)) return means;
    if (!covers(cumulative, start, end)) continue;
    means.time.push_back(start + 0.5 * length);
    means.value.push_back(mean_rate(cumulative, start, end));
  }
}

double first_maximum_time(const Curve& values, double reach) {
  for (std::size_t n = 1; n < values.time.size(); ++n) {
    if (!covers(values, values.time[n], values.time[n] + reach)) break;
    bool largest = true;
    for (std::size_t m = 0; m < values.time.size() && largest; ++m) {
      if (m == n || std::abs(values.time[m] - values.time[n]) > reach * (1 + 1e-9)) continue;
      largest = m < n ? values.value[m] < values.value[n] : values.value[m] <= values.value[n];
    }
    if (largest) return values.time[n];
  }
  return none;
}

Curve about_running_mean(const Curve& curve, double length, double from, double to) {
  const Curve sums = integral(curve);
  Curve left;
  for (std::size_t n = 0; n < curve.time.size(); ++n) {
    const double t = curve.time[n];
    if (t <= from || t > to || !covers(sums, t - 0.5 * length, t + 0.5 * length)) continue;
    left.time.push_back(t);
    left.value.push_back(curve.value[n] - mean_rate(sums, t - 0.5 * length, t + 0.5 * length));
  }
  return left;
}

}  // namespace talus
