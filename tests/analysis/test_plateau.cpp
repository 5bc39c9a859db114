// SPDX-License-Identifier: Apache-2.0
#include "analysis/discharge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace talus {
namespace {

/// The integral of a rate, one value a millisecond.
template <class Rate>
Curve integral_of(Rate&& rate, double end) {
  Curve curve{{0}, {0}};
  for (int n = 1; 1e-3 * n <= end + 1e-9; ++n) {
    curve.time.push_back(1e-3 * n);
    curve.value.push_back(curve.value.back() + 1e-3 * rate(1e-3 * (n - 0.5)));
  }
  return curve;
}

/// Rises over 0.1 s to 3, stays until 0.5 s, and falls to nothing at 0.7 s.
double trapezoid(double t) {
  return 3 * std::clamp(std::min(t / 0.1, (0.7 - t) / 0.2), 0.0, 1.0);
}

TEST(FindPlateau, FindsTheLevelPartOfARun) {
  const Plateau found = find_plateau(integral_of(trapezoid, 1), 0.02, 0.05, 0, 1);
  EXPECT_NEAR(found.value, 3, 0.02);
  EXPECT_NEAR(found.from, 0.1, 0.021);
  EXPECT_NEAR(found.to, 0.5, 0.021);
}

TEST(FindPlateau, RestIsNone) {
  const auto late = [](double t) { return t > 0.8 ? 2.0 : 0.0; };
  const Plateau found = find_plateau(integral_of(late, 1), 0.02, 0.05, 0, 1);
  EXPECT_NEAR(found.value, 2, 1e-9);
  EXPECT_NEAR(found.from, 0.8, 1e-9);
  EXPECT_TRUE(std::isnan(find_plateau(integral_of([](double) { return 0.0; }, 1), 0.02, 0.05, 0, 1).value));
}

TEST(FindPlateau, ARateThatOnlyFallsHasNone) {
  const auto falling = [](double t) { return std::exp(-20 * t); };
  EXPECT_TRUE(std::isnan(find_plateau(integral_of(falling, 1), 0.02, 0.05, 0, 1).value));
}

/// A rate of 5 with noise whose correlation falls to `rho` from one interval of 2 ms to the next, and a slope.
Curve noisy(std::uint32_t seed, double end, double rho, double deviation, double slope = 0) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, deviation * std::sqrt(1 - rho * rho));
  Curve curve{{0}, {0}};
  double noise = 0;
  for (int n = 0; n < 200; ++n) noise = rho * noise + normal(engine);
  for (int n = 1; 2e-3 * n <= end + 1e-9; ++n) {
    noise = rho * noise + normal(engine);
    curve.time.push_back(2e-3 * n);
    curve.value.push_back(curve.value.back() + 2e-3 * (5 + noise + slope * (curve.time.back() - 0.5 * end)));
  }
  return curve;
}

TEST(ErrorOfBlocks, TheIntervalHoldsTheTruthAtItsRate) {
  for (const double rho : {0.0, 0.9}) {
    int held = 0, runs = 400;
    for (int seed = 0; seed < runs; ++seed) {
      const Curve curve = noisy(static_cast<std::uint32_t>(seed), 4, rho, 0.5);
      const double error = error_of_blocks(curve, 0.02, 0, 4);
      ASSERT_TRUE(std::isfinite(error));
      held += std::abs(curve.value.back() / 4 - 5) <= error;
    }
    EXPECT_NEAR(held / double(runs), 0.95, 0.035) << "correlation " << rho;
  }
}

TEST(ErrorOfBlocks, TooShortAStretchHasNone) {
  EXPECT_TRUE(std::isnan(error_of_blocks(noisy(1, 0.08, 0, 0.5), 0.02, 0, 0.08))) << "no five blocks as long as a mean";
  // A slow swing: the whole stretch is a few correlation times.
  const auto slow = [](double t) { return 5 + 0.05 * std::sin(2 * std::numbers::pi * t / 0.4); };
  const Plateau found = find_plateau(integral_of(slow, 0.4), 0.02, 0.05, 0, 0.4);
  EXPECT_NEAR(found.value, 5, 1e-6);
  EXPECT_TRUE(std::isnan(found.error));
}

TEST(ErrorOfBlocks, BetweenTheDataNothingIsKnown) {
  Curve coarse;  // a few of the data, between which the curve is straight
  const Curve all = noisy(4, 4, 0.9, 0.5);
  for (std::size_t n = 0; n < all.time.size(); n += 400)
    coarse.time.push_back(all.time[n]), coarse.value.push_back(all.value[n]);
  EXPECT_TRUE(std::isfinite(error_of_blocks(all, 0.02, 0, 4)));
  EXPECT_EQ(coarse.time.size(), 6u);
  EXPECT_TRUE(std::isnan(error_of_blocks(coarse, 0.02, 0.8, 3.2)));
}

TEST(ErrorOfBlocks, ATrendIsPartOfTheError) {
  const double level = error_of_blocks(noisy(3, 4, 0, 0.1), 0.02, 0, 4);
  const double rising = error_of_blocks(noisy(3, 4, 0, 0.1, 0.2), 0.02, 0, 4);
  EXPECT_TRUE(std::isnan(rising) || rising > 3 * level) << level << " and " << rising;
}

TEST(CorrelationTime, IsOneOfIndependentValuesAndThatOfTheSeriesElse) {
  std::vector<double> values;
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  double noise = 0;
  for (int n = 0; n < 20000; ++n) values.push_back(noise = 0.8 * noise + normal(engine));
  EXPECT_NEAR(correlation_time(values), 9, 1.5) << "(1 + 0.8)/(1 - 0.8)";
  for (double& v : values) v = normal(engine);
  EXPECT_NEAR(correlation_time(values), 1, 0.1);
  EXPECT_EQ(correlation_time(std::vector<double>(10, 3.0)), 1);
}

TEST(FindPlateau, TakesThousandsOfMeansInNoTime) {
  const Plateau found = find_plateau(noisy(2, 60, 0, 0.2), 0.02, 0.1, 0, 60);
  EXPECT_NEAR(found.value, 5, 0.05);
}

}  // namespace
}  // namespace talus
