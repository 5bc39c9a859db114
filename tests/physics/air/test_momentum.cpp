// SPDX-License-Identifier: Apache-2.0
#include "physics/air/momentum.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::air {
namespace {

/// Error of the derivative of exp at 0 from carried velocities, in a flow of either direction.
double derivative_error(double h, double wide, double direction, double upwind) {
  const auto u = [h](int i) { return std::exp(i * h); };
  const auto at = [&](int i) { return carried_velocity(u(i - 1), u(i), u(i + 1), u(i + 2), wide, direction, upwind); };
  return std::abs((at(0) - at(-1)) / h - 1);
}

TEST(CarriedVelocity, HasTheOrderOfItsScheme) {
  const auto order = [](double wide, double direction, double upwind) {
    return std::log2(derivative_error(0.1, wide, direction, upwind) / derivative_error(0.05, wide, direction, upwind));
  };
  EXPECT_NEAR(order(1, 1, 0), 4, 0.05);
  EXPECT_NEAR(order(0, 1, 0), 2, 0.05);
  for (const double direction : {1.0, -1.0}) {
    EXPECT_NEAR(order(1, direction, 1), 3, 0.15);
    EXPECT_NEAR(order(0, direction, 1), 1, 0.1);
  }
}

TEST(CarriedVelocity, LooksUpstream) {
  // Next to a wall the upstream value itself; in the open the third-order weights (-1, 5, 2)/6 upstream.
  EXPECT_DOUBLE_EQ(carried_velocity(9, 2, 7, 9, 0, 1, 1), 2);
  EXPECT_DOUBLE_EQ(carried_velocity(9, 2, 7, 9, 0, -1, 1), 7);
  EXPECT_DOUBLE_EQ(carried_velocity(3, 2, 7, 100, 1, 1, 1), (-3 + 5 * 2 + 2 * 7) / 6.0);
  EXPECT_DOUBLE_EQ(carried_velocity(100, 2, 7, 3, 1, -1, 1), (2 * 2 + 5 * 7 - 3) / 6.0);
}

TEST(ViscousForce, IsThePrintedTerm) {
  EXPECT_DOUBLE_EQ(viscous_force(0.4, 1.8e-5, 200, 30), 0.4 * 1.8e-5 * 210);
}

}  // namespace
}  // namespace talus::air
