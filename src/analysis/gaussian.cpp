// SPDX-License-Identifier: Apache-2.0
/// The Gaussian's part of statistics.hpp: density, fits, test.
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

double squared_distance(const Histogram& histogram, const Gaussian& gaussian) {
  double sum = 0;
  for (std::size_t bin = 0; bin < histogram.count.size(); ++bin)
    sum += std::pow(histogram.density(bin) - gaussian.density(histogram.middle(bin)), 2);
  return sum;
}

Gaussian moments_of(const Histogram& histogram) {
  double count = 0, first = 0, second = 0;
  for (std::size_t bin = 0; bin < histogram.count.size(); ++bin) {
    const double weight = static_cast<double>(histogram.count[bin]), x = histogram.middle(bin);
    count += weight;
    first += weight * x;
    second += weight * x * x;
  }
  const double centre = first / count;
  return {centre,
          std::sqrt(std::max(second / count - centre * centre, histogram.bin_width * histogram.bin_width / 12))};
}

}  // namespace

double Gaussian::density(double x) const {
  const double z = (x - mean) / deviation;
  return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2 * std::numbers::pi));
}

Gaussian gaussian_of_moments(std::span<const double> sample) {
  return {mean(sample), standard_deviation(sample)};
}

Gaussian gaussian_of_least_squares(const Histogram& histogram) {
  const auto occupied =
      std::count_if(histogram.count.begin(), histogram.count.end(), [](std::size_t count) { return count > 0; });
  if (occupied < 3) return {nan, nan};
  Gaussian best = moments_of(histogram);
  double distance = squared_distance(histogram, best);
  for (int iteration = 0; iteration < 100; ++iteration) {
    // Normal equations of the residuals' first-order change with mean and deviation.
    double mm = 0, md = 0, dd = 0, m = 0, d = 0;
    for (std::size_t bin = 0; bin < histogram.count.size(); ++bin) {
      const double x = histogram.middle(bin), z = (x - best.mean) / best.deviation, p = best.density(x);
      const double by_mean = p * z / best.deviation, by_deviation = p * (z * z - 1) / best.deviation;
      const double residual = histogram.density(bin) - p;
      mm += by_mean * by_mean;
      md += by_mean * by_deviation;
      dd += by_deviation * by_deviation;
      m += by_mean * residual;
      d += by_deviation * residual;
    }
    const double determinant = mm * dd - md * md;
    if (!(determinant > 0)) return {nan, nan};
    const double mean_step = (dd * m - md * d) / determinant, deviation_step = (mm * d - md * m) / determinant;
    // Half the step until it leads downhill.
    double share = 1;
    Gaussian next;
    double next_distance;
    do {
      next = {best.mean + share * mean_step, best.deviation + share * deviation_step};
      next_distance = next.deviation > 0 ? squared_distance(histogram, next) : std::numeric_limits<double>::infinity();
      share *= 0.5;
    } while (next_distance > distance && share > 1e-9);
    if (next_distance > distance) break;
    const double change = std::abs(next.mean - best.mean) + std::abs(next.deviation - best.deviation);
    best = next;
    distance = next_distance;
    if (change < 1e-12 * best.deviation) break;
  }
  return best;
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
