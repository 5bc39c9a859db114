// SPDX-License-Identifier: Apache-2.0
#include "analysis/discharge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/statistics.hpp"

namespace talus {
namespace {

template <class Function>
Curve sampled(double from, double to, double step, Function&& f) {
  Curve curve;
  for (int n = 0; from + n * step <= to + 1e-12; ++n) {
    curve.time.push_back(from + n * step);
    curve.value.push_back(f(curve.time.back()));
  }
  return curve;
}

TEST(Discharge, MeansOfALinearRateAreItsValueInTheMiddle) {
  // Q = 2 + 3 t, passed = 2 t + 1.5 t^2, on uneven times
  Curve passed;
  for (int n = 0; n <= 2000; ++n) {
    const double t = 1e-3 * n + 2e-4 * std::sin(n);
    passed.time.push_back(t);
    passed.value.push_back(2 * t + 1.5 * t * t);
  }
  EXPECT_NEAR(mean_rate(passed, 0.4, 0.6), 2 + 3 * 0.5, 1e-4);
  const Curve means = mean_rates(passed, 0.1, 0.05, 0.2, 1.0);
  ASSERT_EQ(means.time.size(), 15u);
  for (std::size_t n = 0; n < means.time.size(); ++n) EXPECT_NEAR(means.value[n], 2 + 3 * means.time[n], 1e-4);
  EXPECT_TRUE(std::isnan(mean_rate(passed, 1.9, 2.1)));
  EXPECT_TRUE(mean_rates({}, 0.1, 0.1, 0, 1).time.empty());
}

TEST(Discharge, IntegralAndScaled) {
  const Curve line = sampled(0, 2, 0.1, [](double t) { return 4 * t; });
  EXPECT_NEAR(integral(line).value.back(), 8, 1e-12);
  EXPECT_NEAR(scaled(line, -0.5, 7).value.back(), 3, 1e-12);
}

TEST(Discharge, FirstMaximumIsTheFirstOfAllWithinReach) {
  // a bump of 1 at 0.02, one of 0.8 at 0.023 in its shadow, one of 2 at 0.06
  const auto bump = [](double t, double at, double size) { return size * std::exp(-std::pow((t - at) / 1e-3, 2)); };
  const Curve curve =
      sampled(0, 0.1, 2e-4, [&](double t) { return bump(t, 0.02, 1) + bump(t, 0.023, 0.8) + bump(t, 0.06, 2) + t; });
  EXPECT_NEAR(first_maximum_time(curve, 6e-3), 0.02, 2e-4);
  EXPECT_NEAR(first_maximum_time(curve, 4e-2), 0.06, 2e-4) << "a longer reach";
  EXPECT_TRUE(std::isnan(first_maximum_time(curve, 5e-2))) << "ends before it is sure";
  EXPECT_TRUE(std::isnan(first_maximum_time(sampled(0, 1, 0.01, [](double t) { return t; }), 0.1)));
  EXPECT_TRUE(std::isnan(first_maximum_time({}, 0.1)));
}

TEST(Discharge, FluctuationOfASinusoidOnATrend) {
  // 20 ms hold two whole periods of 10 ms: the mean is the trend.
  const Curve curve =
      sampled(0, 0.4, 1e-4, [](double t) { return 3 - 5 * t + 0.2 * std::sin(2 * std::numbers::pi * t / 0.01); });
  EXPECT_NEAR(standard_deviation(about_running_mean(curve, 0.02, 0.05, 0.3).value), 0.2 / std::sqrt(2), 1e-4);
}

}  // namespace
}  // namespace talus
