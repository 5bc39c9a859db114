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

std::vector<double> ranks(std::span<const double> sample) {
  std::vector<std::size_t> order(sample.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sample[a] < sample[b]; });
  std::vector<double> rank(sample.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && sample[order[end]] == sample[order[begin]]) ++end;
    for (std::size_t n = begin; n < end; ++n) rank[order[n]] = 0.5 * static_cast<double>(begin + end + 1);
    begin = end;
  }
  return rank;
}

double r_squared(std::span<const double> x, std::span<const double> y, double intercept, double slope) {
  double residual = 0;
  for (std::size_t n = 0; n < x.size(); ++n) residual += std::pow(y[n] - intercept - slope * x[n], 2);
  const double total = cross_sum(y, y);
  return total > 0 ? 1 - residual / total : nan;
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
  const double place = probability * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), lower, values.end());
  if (below + 1 == values.size()) return *lower;
  return std::lerp(*lower, *std::min_element(lower + 1, values.end()), place - static_cast<double>(below));
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

double student_t(double freedom) {
  constexpr double x = 1.959963984540054, x3 = x * x * x, x5 = x3 * x * x, x7 = x5 * x * x;
  return x + (x3 + x) / (4 * freedom) + (5 * x5 + 16 * x3 + 3 * x) / (96 * std::pow(freedom, 2)) +
         (3 * x7 + 19 * x5 + 17 * x3 - 15 * x) / (384 * std::pow(freedom, 3));
}

double spearman_correlation(std::span<const double> x, std::span<const double> y) {
  require_pairs(x, y);
  const std::vector<double> x_rank = ranks(x), y_rank = ranks(y);
  const double scatter = cross_sum(x_rank, x_rank) * cross_sum(y_rank, y_rank);
  return scatter > 0 ? cross_sum(x_rank, y_rank) / std::sqrt(scatter) : nan;
}

Line fit_line(std::span<const double> x, std::span<const double> y) {
  require_pairs(x, y);
  const double scatter = cross_sum(x, x);
  if (!(scatter > 0)) return {nan, nan, nan};
  const double slope = cross_sum(x, y) / scatter;
  const double intercept = mean(y) - slope * mean(x);
  return {intercept, slope, r_squared(x, y, intercept, slope)};
}

Line fit_line_through_origin(std::span<const double> x, std::span<const double> y) {
  require_pairs(x, y);
  const double squares = std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
  if (!(squares > 0)) return {0, nan, nan};
  const double slope = std::inner_product(x.begin(), x.end(), y.begin(), 0.0) / squares;
  return {0, slope, r_squared(x, y, 0, slope)};
}

}  // namespace talus
