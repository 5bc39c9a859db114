// SPDX-License-Identifier: Apache-2.0
/// Statistics of samples: moments, quantiles, histograms, a test of normality, lines. A result that a sample is too
/// small for, or that divides by a spread of zero, is nan.
#pragma once

#include <span>
#include <vector>

namespace talus {

double mean(std::span<const double> sample);

/// With n - 1.
double standard_deviation(std::span<const double> sample);

/// Third central moment over the 3/2 power of the second (both with n).
double skewness(std::span<const double> sample);

/// Linear between order statistics, the least at 0 and the largest at 1 (Hyndman & Fan 1996, type 7).
/// \param probability 0 to 1
double quantile(std::span<const double> sample, double probability);
double median(std::span<const double> sample);

/// Equal bins from least to most; the last holds its upper edge. Values outside are in none.
struct Histogram {
  double least = 0;
  double bin_width = 0;
  std::vector<std::size_t> count;
  std::size_t total = 0;  ///< of the sample, with the values outside

  double middle(std::size_t bin) const { return least + (static_cast<double>(bin) + 0.5) * bin_width; }
  /// Probability density, 1/unit of the values.
  double density(std::size_t bin) const {
    return static_cast<double>(count[bin]) / (static_cast<double>(total) * bin_width);
  }
};
/// \param bins at least 1; \param most > least
Histogram histogram(std::span<const double> sample, double least, double most, std::size_t bins);

/// Anderson & Darling's test of normality with mean and standard deviation estimated from the sample.
struct NormalityTest {
  double statistic = 0;  ///< A²
  double adjusted = 0;   ///< A² (1 + 0.75/n + 2.25/n²)
  double p_value = 0;    ///< probability of a larger statistic from a Gaussian; D'Agostino & Stephens 1986, table 4.9
};
/// Nan for fewer than 8 values, to which the table does not reach.
NormalityTest anderson_darling(std::span<const double> sample);

/// Probability of a larger adjusted statistic: D'Agostino & Stephens, Goodness-of-Fit Techniques (1986), table 4.9.
double anderson_darling_p_value(double adjusted);

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
