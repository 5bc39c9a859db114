// SPDX-License-Identifier: Apache-2.0
#include "analysis/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace talus {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Sum of (x - x_mean)(y - y_mean).
double cross_sum(std::span<const double> x, std::span<const double> y) {
  const double x_mean = mean(x), y_mean = mean(y);
  double sum = 0;
  for (std::size_t n = 0; n < x.size(); ++n) sum += (x[n] - x_mean) * (y[n] - y_mean);
  return sum;
}

void require_pairs(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw std::invalid_argument("x and y differ in length");
}

/// Logarithm of the standard normal distribution function. Below -37, where erfc underflows, the first term of the
/// tail's asymptotic series errs by less than 1/z² < 1e-3, in a logarithm of -690.
double log_normal_below(double z) {
  if (z < -37) return -0.5 * z * z - std::log(-z) - 0.5 * std::log(2 * std::numbers::pi);
  return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
}

}  // namespace

double mean(std::span<const double> sample) {
  if (sample.empty()) return nan;
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

double standard_deviation(std::span<const double> sample) {
  if (sample.size() < 2) return nan;
  return std::sqrt(cross_sum(sample, sample) / static_cast<double>(sample.size() - 1));
}

double skewness(std::span<const double> sample) {
  const double centre = mean(sample), count = static_cast<double>(sample.size());
  double second = 0, third = 0;
  for (const double x : sample) {
    second += std::pow(x - centre, 2) / count;
    third += std::pow(x - centre, 3) / count;
  }
  return second > 0 ? third / std::pow(second, 1.5) : nan;
}

double quantile(std::span<const double> sample, double probability) {
  if (sample.empty() || !(probability >= 0 && probability <= 1)) return nan;
  std::vector<double> values(sample.begin(), sample.end());
  const double rank = probability * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), lower, values.end());
  if (below + 1 == values.size()) return *lower;
  return std::lerp(*lower, *std::min_element(lower + 1, values.end()), rank - static_cast<double>(below));
}

double median(std::span<const double> sample) {
  return quantile(sample, 0.5);
}

Histogram histogram(std::span<const double> sample, double least, double most, std::size_t bins) {
  if (bins == 0 || !(most > least)) throw std::invalid_argument("a histogram needs bins and most > least");
  Histogram result{.least = least,
                   .bin_width = (most - least) / static_cast<double>(bins),
                   .count = std::vector<std::size_t>(bins, 0),
                   .total = sample.size()};
  for (const double x : sample) {
    if (!(x >= least && x <= most)) continue;
    const auto bin = static_cast<std::size_t>((x - least) / result.bin_width);
    ++result.count[std::min(bin, bins - 1)];
  }
  return result;
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
  const double centre = mean(sample), deviation = standard_deviation(sample);
  if (sample.size() < 8 || !(deviation > 0)) return {nan, nan, nan};
  std::vector<double> z;
  for (const double x : sample) z.push_back((x - centre) / deviation);
  std::sort(z.begin(), z.end());
  const double count = static_cast<double>(z.size());
  double sum = 0;
  for (std::size_t n = 0; n < z.size(); ++n)
    sum += (2 * static_cast<double>(n) + 1) * (log_normal_below(z[n]) + log_normal_below(-z[z.size() - 1 - n]));
  const double statistic = -count - sum / count;
  const double adjusted = statistic * (1 + 0.75 / count + 2.25 / (count * count));
  return {statistic, adjusted, anderson_darling_p_value(adjusted)};
}

double student_t(double freedom) {
  constexpr double x = 1.959963984540054, x3 = x * x * x, x5 = x3 * x * x, x7 = x5 * x * x;
  return x + (x3 + x) / (4 * freedom) + (5 * x5 + 16 * x3 + 3 * x) / (96 * std::pow(freedom, 2)) +
         (3 * x7 + 19 * x5 + 17 * x3 - 15 * x) / (384 * std::pow(freedom, 3));
}

Line fit_line(std::span<const double> x, std::span<const double> y) {
  require_pairs(x, y);
  const double scatter = cross_sum(x, x);
  if (!(scatter > 0)) return {nan, nan};
  const double slope = cross_sum(x, y) / scatter;
  const double intercept = mean(y) - slope * mean(x);
  return {intercept, slope};
}

}  // namespace talus
