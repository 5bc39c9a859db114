// SPDX-License-Identifier: Apache-2.0
/// Statistics of samples: moments, quantiles, lines. A result that a sample is too
/// small for, or that divides by a spread of zero, is nan.
#pragma once

#include <span>
#include <vector>

namespace talus {

double mean(std::span<const double> sample);

/// With n - 1.
double standard_deviation(std::span<const double> sample);

/// Linear between order statistics, the least at 0 and the largest at 1 (Hyndman & Fan 1996, type 7).
/// \param probability 0 to 1
double quantile(std::span<const double> sample, double probability);
double median(std::span<const double> sample);

/// Quantile 0.975 of Student's t: a two-sided 95 % interval. Abramowitz & Stegun 26.7.5, within 0.3 % from 4 degrees
/// of freedom on. \param freedom > 0
double student_t(double freedom);

/// y = intercept + slope x with the least sum of squared distances along y.
struct Line {
  double intercept = 0;
  double slope = 0;
};
/// \throws std::invalid_argument if x and y differ in length
Line fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace talus
