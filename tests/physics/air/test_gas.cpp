// SPDX-License-Identifier: Apache-2.0
#include "physics/air/gas.hpp"

#include <gtest/gtest.h>

namespace talus::air {
namespace {

TEST(Gas, DensityOfAirAtRoomTemperature) {
  EXPECT_NEAR(density(101325, 293.15), 1.204, 5e-4);
  EXPECT_NEAR(density(10, 293.15), 1.188e-4, 1e-7);
}

TEST(Gas, SlipFactorIsThePapersAtBothPressures) {
  const double viscosity = 1.82e-5, temperature = 293.15, diameter = 200e-6;
  EXPECT_NEAR(mean_free_path(viscosity, 101325, temperature), 6.53e-8, 1e-10);
  EXPECT_NEAR(slip_factor(mean_free_path(viscosity, 101325, temperature), diameter), 1.0, 1e-3);
  EXPECT_NEAR(slip_factor(mean_free_path(viscosity, 10, temperature), diameter), 12, 0.6);
}

TEST(Gas, SlipFactorHasItsLimits) {
  EXPECT_EQ(slip_factor(0, 1e-4), 1);
  // Free molecules: the drag falls as 1/(1.657 Kn).
  EXPECT_NEAR(slip_factor(1, 1e-4) / slip_factor(0.5, 1e-4), 2, 1e-3);
  EXPECT_NEAR(slip_factor(1, 1e-4) / 2e4, 1.657, 1e-3);
}

}  // namespace
}  // namespace talus::air
