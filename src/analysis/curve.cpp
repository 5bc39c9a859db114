// SPDX-License-Identifier: Apache-2.0
#include "analysis/curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

// Times are sums of steps: equal ones differ by rounding.
bool at_or_before(double t, double bound) {
  return t <= bound + 1e-9 * std::abs(bound);
}

void require_points(const Curve& curve) {
  if (curve.time.empty() || curve.time.size() != curve.value.size())
    throw std::invalid_argument("a curve needs points, and one value a time");
}

}  // namespace

Curve part(const Curve& curve, double from, double to) {
  Curve result;
  for (std::size_t n = 0; n < curve.time.size(); ++n)
    if (!at_or_before(curve.time[n], from) && at_or_before(curve.time[n], to)) {
      result.time.push_back(curve.time[n]);
      result.value.push_back(curve.value[n]);
    }
  return result;
}

double value_at(const Curve& curve, double t) {
  require_points(curve);
  // A bound missed by rounding is the bound.
  if (!at_or_before(curve.time.front(), t) || !at_or_before(t, curve.time.back()))
    throw std::invalid_argument("the time is outside the curve");
  const auto after = std::upper_bound(curve.time.begin(), curve.time.end(), t);
  if (after == curve.time.begin()) return curve.value.front();
  if (after == curve.time.end()) return curve.value.back();
  const auto n = static_cast<std::size_t>(after - curve.time.begin());
  return std::lerp(curve.value[n - 1], curve.value[n], (t - curve.time[n - 1]) / (curve.time[n] - curve.time[n - 1]));
}

std::size_t nearest_point(std::span<const double> time, double t) {
  if (time.empty()) throw std::invalid_argument("a curve without points has no nearest one");
  std::size_t nearest = 0;
  for (std::size_t n = 1; n < time.size(); ++n)
    if (std::abs(time[n] - t) < std::abs(time[nearest] - t)) nearest = n;
  return nearest;
}

Extremes extremes(const Curve& curve) {
  require_points(curve);
  if (std::any_of(curve.value.begin(), curve.value.end(), [](double value) { return std::isnan(value); })) {
    return {no_value, no_value, no_value};
  }
  const auto [least, largest] = std::minmax_element(curve.value.begin(), curve.value.end());
  // minmax_element finds the last of equal largest values.
  const auto first = std::find(curve.value.begin(), curve.value.end(), *largest);
  return {*least, *largest, curve.time[static_cast<std::size_t>(first - curve.value.begin())]};
}

double first_time_at_or_below(const Curve& curve, double level) {
  for (std::size_t n = 0; n < curve.time.size(); ++n) {
    if (!(curve.value[n] <= level)) continue;
    if (n == 0) return curve.time[0];
    const double share = (curve.value[n - 1] - level) / (curve.value[n - 1] - curve.value[n]);
    return std::lerp(curve.time[n - 1], curve.time[n], share);
  }
  return no_value;
}

}  // namespace talus
