// SPDX-License-Identifier: Apache-2.0
#include "analysis/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "analysis/curve.hpp"

namespace talus {

namespace {

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

}  // namespace

double mean(std::span<const double> sample) {
  if (sample.empty()) return no_value;
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

double standard_deviation(std::span<const double> sample) {
  if (sample.size() < 2) return no_value;
  return std::sqrt(cross_sum(sample, sample) / static_cast<double>(sample.size() - 1));
}

double quantile(std::span<const double> sample, double probability) {
  if (sample.empty() || !(probability >= 0 && probability <= 1)) return no_value;
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

double student_t(double freedom) {
  constexpr double x = 1.959963984540054, x3 = x * x * x, x5 = x3 * x * x, x7 = x5 * x * x;
  return x + (x3 + x) / (4 * freedom) + (5 * x5 + 16 * x3 + 3 * x) / (96 * std::pow(freedom, 2)) +
         (3 * x7 + 19 * x5 + 17 * x3 - 15 * x) / (384 * std::pow(freedom, 3));
}

Line fit_line(std::span<const double> x, std::span<const double> y) {
  require_pairs(x, y);
  const double scatter = cross_sum(x, x);
  if (!(scatter > 0)) return {no_value, no_value};
  const double slope = cross_sum(x, y) / scatter;
  const double intercept = mean(y) - slope * mean(x);
  return {intercept, slope};
}

}  // namespace talus
