// SPDX-License-Identifier: Apache-2.0
/// The Gaussian's part of statistics.hpp: density, moments, test.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Logarithm of the standard normal distribution function. Below -37, where erfc underflows, the first term of the
/// tail's asymptotic series errs by less than 1/z² < 1e-3, in a logarithm of -690.
double log_normal_below(double z) {
  if (z < -37) return -0.5 * z * z - std::log(-z) - 0.5 * std::log(2 * std::numbers::pi);
  return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
}

}  // namespace

double Gaussian::density(double x) const {
  const double z = (x - mean) / deviation;
  return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2 * std::numbers::pi));
}

Gaussian gaussian_of_moments(std::span<const double> sample) {
  return {mean(sample), standard_deviation(sample)};
}

double anderson_darling_p_value(double a) {
  // The formulas turn around far outside the table.
  if (a > 10) return 0;
  if (a >= 0.6) return std::exp(1.2937 - 5.709 * a + 0.0186 * a * a);
  if (a >= 0.34) return std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
  if (a >= 0.2) return 1 - std::exp(-8.318 + 42.796 * a - 59.938 * a * a);
  return 1 - std::exp(-13.436 + 101.14 * a - 223.73 * a * a);
}

NormalityTest anderson_darling(std::span<const double> sample) {
  const Gaussian gaussian = gaussian_of_moments(sample);
  if (sample.size() < 8 || !(gaussian.deviation > 0)) return {nan, nan, nan};
  std::vector<double> z;
  for (const double x : sample) z.push_back((x - gaussian.mean) / gaussian.deviation);
  std::sort(z.begin(), z.end());
  const double count = static_cast<double>(z.size());
  double sum = 0;
  for (std::size_t n = 0; n < z.size(); ++n)
    sum += (2 * static_cast<double>(n) + 1) * (log_normal_below(z[n]) + log_normal_below(-z[z.size() - 1 - n]));
  const double statistic = -count - sum / count;
  const double adjusted = statistic * (1 + 0.75 / count + 2.25 / (count * count));
  return {statistic, adjusted, anderson_darling_p_value(adjusted)};
}

}  // namespace talus
