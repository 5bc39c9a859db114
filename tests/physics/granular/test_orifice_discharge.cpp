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

TEST(OrificeDischarge, OfARectangleIsThatOfItsHydraulicDiameter) {
  // A square has the hydraulic diameter of the circle in it, and its area is larger by 4/pi.
  EXPECT_NEAR(rectangular_discharge(0.03, 0.03, false, 1500, 9.81, 1e-3) / orifice_discharge(0.03, 1500, 9.81, 1e-3),
              4 / std::numbers::pi, 1e-12);
  const double slot = 1500 * std::sqrt(9.81) * 0.01 * std::pow(0.0385, 1.5);
  EXPECT_NEAR(rectangular_discharge(0.04, 0.01, true, 1500, 9.81, 1e-3) / slot, 1.03, 0.02) << "Nedderman's for slots";
  EXPECT_NEAR(rectangular_discharge(0.04, 40, false, 1500, 9.81, 1e-3) /
                  rectangular_discharge(0.04, 40, true, 1500, 9.81, 1e-3),
              1, 1e-3)
      << "a long slot is endless";
  EXPECT_EQ(rectangular_discharge(0.04, 1e-3, false, 1500, 9.81, 1e-3), 0);
}

TEST(OrificeDischarge, ASteepConeDischargesMore) {
  EXPECT_NEAR(factor_of_cone(std::tan(30 * 0.017453292519943295)), 1.212, 1e-3);
  EXPECT_EQ(factor_of_cone(2), 1);
}

}  // namespace
}  // namespace talus::granular
