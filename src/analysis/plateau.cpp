// SPDX-License-Identifier: Apache-2.0
#include "analysis/plateau.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "analysis/discharge.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr std::size_t fewest = 5;

bool is_level(std::span<const double> means, double spread) {
  const double middle = mean(means);
  return std::all_of(means.begin(), means.end(),
                     [&](double m) { return std::abs(m - middle) <= spread * std::abs(middle); });
}

/// Correlation of each value with the next.
double correlation_of_neighbours(std::span<const double> values) {
  const double middle = mean(values);
  double same = 0, next = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    same += (values[n] - middle) * (values[n] - middle);
    if (n > 0) next += (values[n] - middle) * (values[n - 1] - middle);
  }
  return same > 0 ? next / same : 0;
}

double error_of_mean(std::span<const double> values) {
  const double r = std::max(0.0, correlation_of_neighbours(values)), count = static_cast<double>(values.size());
  return 2 * standard_deviation(values) / std::sqrt(std::max(2.0, count * (1 - r) / (1 + r)));
}

}  // namespace

Plateau find_plateau(const Curve& cumulative, double length, double spread, double from, double to) {
  const Curve means = mean_rates(cumulative, length, length, from, to);
  if (means.value.size() < fewest) return {};
  const double half = 0.5 * *std::max_element(means.value.begin(), means.value.end());
  if (!(half > 0)) return {};
  std::size_t best = 0, longest = 0;
  for (std::size_t n = 0; n < means.value.size(); ++n) {
    if (means.value[n] < half) continue;
    for (std::size_t count = means.value.size() - n; count > std::max(longest, fewest - 1); --count)
      if (is_level(std::span(means.value).subspan(n, count), spread)) best = n, longest = count;
  }
  if (longest == 0) return {};
  const std::span<const double> level = std::span(means.value).subspan(best, longest);
  return {.from = means.time[best] - 0.5 * length,
          .to = means.time[best + longest - 1] + 0.5 * length,
          .value = mean(level),
          .error = error_of_mean(level)};
}

}  // namespace talus
