// SPDX-License-Identifier: Apache-2.0
#include "analysis/discharge.hpp"
#include "analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace talus {
namespace {

using std::numbers::pi;

template <class Function>
Curve sampled(double rate, double length, Function&& f) {
  Curve curve;
  for (int n = 0; n <= length * rate; ++n) {
    curve.time.push_back(n / rate);
    curve.value.push_back(f(n / rate));
  }
  return curve;
}

TEST(Spectrum, FindsThePeriodOfASinusoidOnATrend) {
  for (const double period : {0.0030, 0.0058, 0.0066, 0.0071, 0.0131}) {
    const Curve curve = sampled(
        5000, 0.25, [&](double t) { return 1500 - 200 * t + 3 * std::sin(2 * pi * t / period + 0.7) + 1e-3 * t * t; });
    // Frequencies are 1 Hz apart.
    EXPECT_NEAR(1 / dominant_period(curve, 2e-3, 20e-3), 1 / period, 0.6) << period;
  }
}

TEST(Spectrum, PeakIsAQuarterOfTheAmplitudesSquare) {
  const Curve curve = sampled(1000, 0.999, [](double t) { return 3 * std::cos(2 * pi * 50 * t); });
  const Curve power = power_spectrum(curve, 40, 60);
  EXPECT_NEAR(extremes(power).max, 9.0 / 4, 1e-3);
  EXPECT_NEAR(extremes(power).max_time, 50, 1e-9);
}

TEST(Spectrum, IsThePlainSum) {
  const Curve curve = sampled(100, 0.37, [](double t) { return std::cos(30 * t) + 5 * t * t; });
  const double n = static_cast<double>(curve.time.size());
  const Line line = fit_line(curve.time, curve.value);
  const Curve power = power_spectrum(curve, 3, 40);
  ASSERT_GT(power.time.size(), 50u);
  for (std::size_t f = 0; f < power.time.size(); ++f) {
    double even = 0, odd = 0, sum = 0;
    for (std::size_t k = 0; k < curve.time.size(); ++k) {
      const double window = 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(k) / n), t = curve.time[k];
      const double left = window * (curve.value[k] - line.intercept - line.slope * t);
      even += left * std::cos(2 * pi * power.time[f] * t), odd += left * std::sin(2 * pi * power.time[f] * t);
      sum += window;
    }
    EXPECT_NEAR(power.value[f], (even * even + odd * odd) / (sum * sum), 1e-14);
  }
}

TEST(Spectrum, TakesTheHigherOfTwoPeaksWithinTheBand) {
  const auto two = [](double weight) {
    return sampled(5000, 0.25, [weight](double t) {
      return std::sin(2 * pi * t / 0.005) + weight * std::sin(2 * pi * t / 0.012) + 50 * std::sin(2 * pi * t / 0.1);
    });
  };
  EXPECT_NEAR(dominant_period(two(0.7), 2e-3, 20e-3), 0.005, 5e-5);
  EXPECT_NEAR(dominant_period(two(1.4), 2e-3, 20e-3), 0.012, 1.5e-4);
  EXPECT_NEAR(dominant_period(two(1.4), 2e-3, 9e-3), 0.005, 5e-5);
}

TEST(Spectrum, WithoutAPeakThereIsNoPeriod) {
  EXPECT_TRUE(std::isnan(dominant_period(sampled(5000, 0.25, [](double) { return 2.0; }), 2e-3, 20e-3)));
  EXPECT_TRUE(std::isnan(dominant_period({}, 2e-3, 20e-3)));
}

TEST(Spectrum, EqualTimesAreInterpolated) {
  const Curve curve{{0, 0.1, 0.4, 1.0}, {0, 1, 4, 10}};
  const Curve equal = at_equal_times(curve, 10, 0.2, 0.8);
  ASSERT_EQ(equal.time.size(), 7u);
  for (std::size_t n = 0; n < 7; ++n) EXPECT_NEAR(equal.value[n], 10 * equal.time[n], 1e-12);
  EXPECT_TRUE(at_equal_times(curve, 10, 0.2, 1.2).time.empty());
}

TEST(Spectrum, CrossingsCountTheSwingsOfASinusoid) {
  const Curve curve = sampled(5000, 0.25, [](double t) { return std::sin(2 * pi * t / 0.0066 + 0.7); });
  EXPECT_NEAR(crossing_period(curve), 0.0066, 1e-6);
  EXPECT_TRUE(std::isnan(crossing_period(sampled(5000, 0.25, [](double t) { return t - 0.1; })))) << "one crossing";
}

}  // namespace
}  // namespace talus
