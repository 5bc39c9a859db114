// SPDX-License-Identifier: Apache-2.0
#include "analysis/plateau.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

TEST(FindPlateau, TheErrorIsThatOfTheMean) {
  // Means that alternate by 1 % about 5: their deviation is 0.05 n/(n - 1), neighbours are unlike.
  const auto swinging = [](double t) { return 5 + (std::fmod(t, 0.04) < 0.02 ? 0.05 : -0.05); };
  const Plateau found = find_plateau(integral_of(swinging, 0.4), 0.02, 0.05, 0, 0.4);
  EXPECT_NEAR(found.value, 5, 1e-9);
  EXPECT_NEAR(found.error, 2 * 0.05 * std::sqrt(20.0 / 19) / std::sqrt(20.0), 1e-9);
  // A slow swing counts as few values: the error is larger than that of as many that are independent.
  const auto slow = [](double t) { return 5 + 0.05 * std::sqrt(2.0) * std::sin(2 * std::numbers::pi * t / 0.4); };
  EXPECT_GT(find_plateau(integral_of(slow, 0.4), 0.02, 0.05, 0, 0.4).error, 2 * found.error);
}

}  // namespace
}  // namespace talus
