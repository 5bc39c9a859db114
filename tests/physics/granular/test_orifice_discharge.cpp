// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/orifice_discharge.hpp"

#include <gtest/gtest.h>

namespace talus::granular {
namespace {

TEST(OrificeDischarge, IsBeverloosInItsExponentAndItsConstant) {
  EXPECT_NEAR(orifice_discharge(0.03, 1500, 9.81, 0), 0.58 * 1500 * std::sqrt(9.81 * std::pow(0.03, 5)), 1e-12);
  EXPECT_NEAR(orifice_discharge(0.08, 1500, 9.81, 0) / orifice_discharge(0.02, 1500, 9.81, 0), 32, 1e-10);
  EXPECT_EQ(orifice_discharge(0.03, 1500, 9.81, 1e-3), orifice_discharge(0.0285, 1500, 9.81, 0)) << "1.5 grains less";
  EXPECT_EQ(orifice_discharge(1e-3, 1500, 9.81, 1e-3), 0);
}

TEST(OrificeDischarge, ASteepConeDischargesMore) {
  EXPECT_NEAR(factor_of_cone(std::tan(30 * 0.017453292519943295)), 1.212, 1e-3);
  EXPECT_EQ(factor_of_cone(2), 1);
}

}  // namespace
}  // namespace talus::granular
