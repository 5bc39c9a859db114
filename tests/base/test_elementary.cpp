// SPDX-License-Identifier: Apache-2.0
#include "base/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace talus {
namespace {

TEST(Power, LogarithmIsThatOfTheLibrary) {
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    const auto exact = static_cast<double>(std::log(static_cast<long double>(x)));
    EXPECT_NEAR(log_of(x), exact, 3e-16 * std::max(1.0, std::abs(exact))) << x;
  }
  for (double x = 0.6; x < 1.6; x += 0.001)
    EXPECT_NEAR(log_of(x), static_cast<double>(std::log(static_cast<long double>(x))), 3e-16) << x;
  EXPECT_EQ(log_of(1), 0);
}

TEST(Power, IsThatOfTheLibrary) {
  for (const double p : {0.687, -2.65, 1.0, 2.0})
    for (double x = 1e-9; x < 1e9; x *= 1.13) {
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(p));
      const double error = 4e-16 * (1 + std::abs(p * std::log(x)));
      EXPECT_NEAR(static_cast<double>(power_of(x, p) / exact), 1, error) << x << " to the " << p;
    }
  EXPECT_EQ(1 + power_of(0, 0.687), 1);
}

}  // namespace
}  // namespace talus
