// SPDX-License-Identifier: Apache-2.0
#include "analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/random.hpp"

namespace talus {
namespace {

TEST(Moments, OfKnownSamples) {
  const std::vector<double> sample = {2, 4, 4, 4, 5, 5, 7, 9};
  EXPECT_DOUBLE_EQ(mean(sample), 5);
  EXPECT_DOUBLE_EQ(standard_deviation(sample), std::sqrt(32.0 / 7));
  EXPECT_DOUBLE_EQ(skewness(sample), (-27 - 1 - 1 - 1 + 8 + 64) / 8.0 / std::pow(4.0, 1.5));
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(standard_deviation(std::vector<double>{1})));
  EXPECT_TRUE(std::isnan(skewness(std::vector<double>{3, 3, 3})));
}

TEST(Quantile, IsLinearBetweenOrderStatistics) {
  const std::vector<double> sample = {40, 15, 50, 20, 35};
  EXPECT_DOUBLE_EQ(median(sample), 35);
  EXPECT_DOUBLE_EQ(quantile(sample, 0), 15);
  EXPECT_DOUBLE_EQ(quantile(sample, 1), 50);
  EXPECT_DOUBLE_EQ(quantile(sample, 0.4), 29);
  EXPECT_DOUBLE_EQ(median(std::vector<double>{1, 2, 3, 10}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Histogram, CountsEdgesOnceAndHasUnitArea) {
  const std::vector<double> sample = {0, 0.5, 1, 1.5, 2, 2, -1, 3};
  const Histogram result = histogram(sample, 0, 2, 2);
  EXPECT_EQ(result.count, (std::vector<std::size_t>{2, 4}));
  EXPECT_EQ(result.total, 8u);
  EXPECT_DOUBLE_EQ(result.middle(1), 1.5);
  EXPECT_DOUBLE_EQ(result.density(1), 0.5);
  EXPECT_THROW(histogram(sample, 1, 1, 3), std::invalid_argument);
}

TEST(AndersonDarling, StatisticIsTheDefiningIntegral) {
  // n times the integral of (F_n - F)² / (F (1 - F)) dF, by the midpoint rule between the order statistics; independent
  // of the sum that the code uses.
  std::vector<double> sample = {148, 154, 158, 160, 161, 162, 166, 170, 182, 195, 236};
  const double centre = mean(sample), deviation = standard_deviation(sample), count = 11;
  double integral = 0;
  double below = 0;
  for (std::size_t n = 0; n <= sample.size(); ++n) {
    const double above = n < sample.size() ? 0.5 * std::erfc(-(sample[n] - centre) / deviation / std::sqrt(2.0)) : 1.0;
    const double share = static_cast<double>(n) / count;
    const int steps = 200000;
    for (int k = 0; k < steps; ++k) {
      const double f = below + (above - below) * (k + 0.5) / steps;
      integral += std::pow(share - f, 2) / (f * (1 - f)) * (above - below) / steps;
    }
    below = above;
  }
  std::reverse(sample.begin(), sample.end());
  const NormalityTest test = anderson_darling(sample);
  EXPECT_NEAR(test.statistic, count * integral, 1e-5);
  EXPECT_NEAR(test.adjusted, test.statistic * (1 + 0.75 / 11 + 2.25 / 121), 1e-14);
  EXPECT_LT(test.p_value, 0.05);
}

TEST(AndersonDarling, PValueMeetsThePublishedCriticalValues) {
  // Stephens 1974, mean and deviation estimated.
  EXPECT_NEAR(anderson_darling_p_value(0.631), 0.10, 0.002);
  EXPECT_NEAR(anderson_darling_p_value(0.752), 0.05, 0.001);
  EXPECT_NEAR(anderson_darling_p_value(0.873), 0.025, 0.0005);
  EXPECT_NEAR(anderson_darling_p_value(1.035), 0.01, 0.0002);
  double previous = 1;
  for (double a = 0.1; a < 12; a += 0.01) {
    EXPECT_LE(anderson_darling_p_value(a), previous + 2e-3) << a;  // the pieces meet within that
    previous = anderson_darling_p_value(a);
  }
}

TEST(AndersonDarling, RejectsNormalSamplesAsOftenAsItSaysAndFindsOthers) {
  Random random(11);
  int rejected = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> sample(50);
    for (double& x : sample) x = 3 + 2 * random.normal();
    rejected += anderson_darling(sample).p_value < 0.05;
  }
  EXPECT_NEAR(rejected, 100, 30);  // three standard deviations
  std::vector<double> skew(300);
  for (double& x : skew) x = std::pow(random.uniform(), 3);
  EXPECT_LT(anderson_darling(skew).p_value, 1e-6);
  EXPECT_TRUE(std::isnan(anderson_darling(std::vector<double>(7, 1.0)).p_value));
  EXPECT_TRUE(std::isnan(anderson_darling(std::vector<double>(20, 1.0)).p_value));
}

TEST(AndersonDarling, ShiftScaleAndMirrorDoNotMatter) {
  const std::vector<double> sample = {1, 2, 2.5, 4, 4.1, 5, 7, 11, 12};
  std::vector<double> changed;
  for (const double x : sample) changed.push_back(100 - 8 * x);
  EXPECT_NEAR(anderson_darling(sample).statistic, anderson_darling(changed).statistic, 1e-12);
}

TEST(Line, OfLeastSquares) {
  const std::vector<double> x = {1, 2, 3}, y = {3, 5, 10};
  const Line line = fit_line(x, y);
  EXPECT_NEAR(line.slope, 3.5, 1e-14);
  EXPECT_NEAR(line.intercept, -1, 1e-14);
  EXPECT_TRUE(std::isnan(fit_line(std::vector<double>{2, 2}, std::vector<double>{1, 3}).slope));
  EXPECT_THROW(fit_line(x, std::vector<double>{1}), std::invalid_argument);
}

}  // namespace
}  // namespace talus
