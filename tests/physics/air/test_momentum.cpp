// SPDX-License-Identifier: Apache-2.0
#include "physics/air/momentum.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::air {
namespace {

/// Error of the derivative of exp at 0 from carried velocities, in a flow of either direction.
double derivative_error(double h, double wide, double direction, double upwind) {
  const auto u = [h](int i) { return std::exp(i * h); };
  const auto at = [&](int i) { return advected_velocity(u(i - 1), u(i), u(i + 1), u(i + 2), wide, direction, upwind); };
  return std::abs((at(0) - at(-1)) / h - 1);
}

TEST(AdvectedVelocity, HasTheOrderOfItsScheme) {
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

TEST(AdvectedVelocity, LooksUpstream) {
  // Next to a wall the upstream value itself; in the open the third-order weights (-1, 5, 2)/6 upstream.
  EXPECT_DOUBLE_EQ(advected_velocity(9, 2, 7, 9, 0, 1, 1), 2);
  EXPECT_DOUBLE_EQ(advected_velocity(9, 2, 7, 9, 0, -1, 1), 7);
  EXPECT_DOUBLE_EQ(advected_velocity(3, 2, 7, 100, 1, 1, 1), (-3 + 5 * 2 + 2 * 7) / 6.0);
  EXPECT_DOUBLE_EQ(advected_velocity(100, 2, 7, 3, 1, -1, 1), (2 * 2 + 5 * 7 - 3) / 6.0);
}

/// Momentum of a flow of sin(x) carried through faces: its difference is the convection d(u u)/dx at second order.
TEST(ConvectedMomentum, ItsDivergenceIsTheConvectionOfEquation18) {
  const double rho = 1.2, phi = 0.5, x = 0.7;
  const auto error = [&](double h) {
    const auto flux = [&](double at) {
      const double u = 0.5 * (std::sin(at - 0.5 * h) + std::sin(at + 0.5 * h));
      return convected_momentum(rho * phi * u, u);
    };
    return std::abs((flux(x + 0.5 * h) - flux(x - 0.5 * h)) / h - rho * phi * std::sin(2 * x));
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 2, 0.05);
}

TEST(ViscousForce, IsThePrintedTerm) {
  EXPECT_DOUBLE_EQ(viscous_force(0.4, 1.8e-5, viscous_divergence(30 / 3.0, 0, 0, 200)), 0.4 * 1.8e-5 * 210);
}

/// Couette's flow between a wall at rest and one that moves with U, velocities in the middle of n cells: no force.
TEST(ViscousDivergence, IsNoneInCouettesFlow) {
  const int n = 5;
  const double wall_speed = 3, width = 0.1 / n, stiffness = 2 / (width * width);
  const auto u = [&](int cell) { return wall_speed * (cell + 0.5) / n; };
  const double bottom = viscous_divergence(0, stiffness * u(0), 0, (u(1) - u(0)) / (width * width));
  const double top =
      viscous_divergence(0, stiffness * u(n - 1), stiffness * wall_speed, (u(n - 2) - u(n - 1)) / (width * width));
  EXPECT_NEAR(bottom, 0, 1e-10 * stiffness);
  EXPECT_NEAR(top, 0, 1e-10 * stiffness);
}

TEST(PressureShare, IsTheVoidFractionInModelAAndAllInModelB) {
  EXPECT_DOUBLE_EQ(pressure_share(0.4, 1), 0.4);
  EXPECT_DOUBLE_EQ(pressure_share(0.4, 0), 1);
  EXPECT_DOUBLE_EQ(pressure_share(1, 0), 1);
}

}  // namespace
}  // namespace talus::air
