// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "base/unit.hpp"
#include "physics/granular/silo.hpp"

namespace talus::granular {

namespace {

TEST(JanssenStress, BeginsAsInALiquidAndTendsToWhatItsWallsLeave) {
  EXPECT_NEAR(janssen_stress(15e3, 0.1, 1e-5), 0.15, 1e-4 * 0.15);
  EXPECT_NEAR(janssen_stress(15e3, 0.1, 10), 1500, 1e-9);
  EXPECT_NEAR(janssen_stress(15e3, 0.1, 0.1), 1500 * (1 - 1 / std::numbers::e), 1e-9);
  EXPECT_NEAR(janssen_stress(15e3, 0.1, 0.1, 1500), 1500, 1e-9) << "a bed that bears its own end stays as it is";
  EXPECT_EQ(janssen_stress(15e3, std::numeric_limits<double>::infinity(), 2, 7), 30e3 + 7);
}

TEST(ConeStress, IsThatOfALiquidInAFilledConeWhateverItsWalls) {
  for (const double friction : {0.0, 0.3, 0.6}) {
    const ConeBearing bearing = cone_at_rest(30 * degree, friction);
    EXPECT_NEAR(bearing.exponent, 0, 1e-12);
    EXPECT_NEAR(cone_stress(bearing, 15e3, 0.1, 0.4, 500), 15e3 * 0.3 + 500, 1e-9);
  }
  EXPECT_NEAR(cone_at_rest(30 * degree, 0).ratio, 1, 1e-12) << "smooth walls bear the vertical stress itself";
}

TEST(ConeStress, BalancesEverySlice) {
  const ConeBearing bearing = cone_in_flow(25 * degree, 0.3, 30 * degree);
  const double weight = 15e3, top = 0.5, step = 1e-6;
  for (const double x : {0.1, 0.3, 0.45}) {
    const auto p = [&](double at) { return cone_stress(bearing, weight, at, top, 800); };
    const double slope = (p(x + step) - p(x - step)) / (2 * step);
    EXPECT_NEAR(slope, bearing.exponent * p(x) / x - weight, 1e-4 * weight);
  }
  EXPECT_NEAR(cone_stress(bearing, weight, top, top, 800), 800, 1e-9);
}

TEST(ConeStress, IsContinuousWhereItsExponentIsOne) {
  const ConeBearing one{0.5, 1}, nearly{0.5, 1 + 1e-6};
  EXPECT_NEAR(cone_stress(one, 15e3, 0.2, 0.5, 100), cone_stress(nearly, 15e3, 0.2, 0.5, 100), 0.02);
}

TEST(ConeInFlow, IsWalkersRatio) {
  // A smooth wall: eps = 0, F = (1 + sin phi)/(1 - sin phi cos 2 beta).
  EXPECT_NEAR(cone_in_flow(20 * degree, 0, 30 * degree).ratio, 1.5 / (1 - 0.5 * std::cos(40 * degree)), 1e-12);
  // As rough as the grains: eps = phi + 90 degrees.
  const double rough = (1 - 0.5 * std::sin(30 * degree)) / (1 + 0.5 * std::sin(70 * degree));
  EXPECT_NEAR(cone_in_flow(20 * degree, std::tan(30 * degree), 30 * degree).ratio, rough, 1e-9);
  EXPECT_NEAR(cone_in_flow(20 * degree, 5, 30 * degree).ratio, rough, 1e-9) << "no rougher than they";
}

TEST(MassFlowHalfAngle, IsJenikes) {
  // By hand: 90 - acos(0.1527)/2 - (20 + asin(0.4465))/2.
  EXPECT_NEAR(mass_flow_half_angle(std::tan(20 * degree), 50 * degree) / degree, 90 - 40.61 - 23.26, 0.02);
  EXPECT_NEAR(mass_flow_half_angle(0, 30 * degree) / degree, 60, 1e-9) << "smooth walls";
  EXPECT_NEAR(mass_flow_half_angle(std::tan(30 * degree), 30 * degree), 0, 1e-7) << "as rough as the grains";
  EXPECT_EQ(mass_flow_half_angle(2, 50 * degree), 0) << "no rougher than they";
}

}  // namespace

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
