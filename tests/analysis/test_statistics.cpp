// SPDX-License-Identifier: Apache-2.0
#include "analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace talus {
namespace {

TEST(Moments, OfKnownSamples) {
  const std::vector<double> sample = {2, 4, 4, 4, 5, 5, 7, 9};
  EXPECT_DOUBLE_EQ(mean(sample), 5);
  EXPECT_DOUBLE_EQ(standard_deviation(sample), std::sqrt(32.0 / 7));
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(standard_deviation(std::vector<double>{1})));
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
