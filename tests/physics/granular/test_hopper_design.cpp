// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/hopper_design.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/unit.hpp"
#include "physics/granular/critical_state.hpp"
#include "physics/granular/silo.hpp"

namespace talus::granular {
namespace {

constexpr double gravity = 9.81;

CriticalStateParameters powder(double strength, double growth) {
  return {.static_friction = 0.5, .tensile_strength = strength, .consolidation_strength = growth};
}

TEST(HopperDesign, RhodesExample) {
  // Introduction to Particle Technology: delta 30, wall 19, chart 30.5 less 3 degrees, ff 1.8, outlet 0.16 m at 0.83
  // kPa.
  const double wall = std::tan(19 * degree), theta = 27.5 * degree;
  EXPECT_NEAR(mass_flow_half_angle(HopperShape::cone, wall, 30 * degree) / degree, 30.5, 0.5);
  const double factor = flow_factor(HopperShape::cone, theta, wall, 30 * degree);
  EXPECT_NEAR(factor, 1.8, 0.2);
  // Its flow function: 0.85 kPa at 1.6 kPa, 0.91 kPa at 2.0 kPa; f_c = sigma_1/ff between.
  const double slope = (0.91 - 0.85) / (2.0 - 1.6), strength = (0.85 - slope * 1.6) / (1 - slope * factor);
  EXPECT_GT(strength, 0.85);
  EXPECT_LT(strength, 0.91);
  EXPECT_NEAR(outlet_factor(HopperShape::cone, theta) * 1e3 * strength / (1300 * gravity), 0.16, 0.05 * 0.16);
}

TEST(HopperDesign, AWedgeEmptiesAtALargerAngleThanACone) {
  for (const double delta : {30.0, 40.0, 50.0, 60.0})
    for (const double wall : {10.0, 15.0, 20.0, 25.0}) {
      const double mu = std::tan(wall * degree);
      const double wedge = mass_flow_half_angle(HopperShape::wedge, mu, delta * degree) / degree,
                   cone = mass_flow_half_angle(HopperShape::cone, mu, delta * degree) / degree;
      EXPECT_GT(wedge, cone) << delta << ' ' << wall;
      EXPECT_LT(wedge, cone + 17) << delta << ' ' << wall;
      EXPECT_GT(wedge, mass_flow_half_angle(HopperShape::wedge, mu + 0.01, delta * degree) / degree) << "rougher";
    }
}

/// ter Borg (1986), as in Schulze, Powders and Bulk Solids (2008), chapter 10; for walls 3 degrees smoother than
/// grains.
double ter_borg(double wall, double delta) {
  return (60.5 + std::atan((50 - delta) / 7.73) / degree / 15.07) *
         (1 - wall / (42.3 + 0.131 * std::exp(0.06 * delta)));
}

TEST(HopperDesign, AWedgesHalfAngleIsThatOfAnotherFitToItsChart) {
  for (const double delta : {30.0, 40.0, 50.0, 60.0, 70.0})
    for (const double wall : {5.0, 10.0, 15.0, 20.0, 25.0})
      EXPECT_NEAR(mass_flow_half_angle(HopperShape::wedge, std::tan(wall * degree), delta * degree) / degree,
                  ter_borg(wall, delta), 2)
          << delta << ' ' << wall;
}

TEST(HopperDesign, FlowFactorsFallWithTheAngleOfFriction) {
  double before = 10;
  for (const double delta : {30.0, 40.0, 50.0, 60.0}) {
    const double now = flow_factor(HopperShape::cone, 18 * degree, std::tan(20 * degree), delta * degree);
    EXPECT_LT(now, before);
    EXPECT_GE(now, 1.1);
    before = now;
  }
}

TEST(HopperDesign, UniformStrengthArchesByItself) {
  const auto law = powder(400, 0);
  const double weight = 1500 * gravity, theta = 20 * degree, phi = std::atan(0.5);
  const double strength = 2 * 0.5 * 400 * std::cos(phi) / (1 - std::sin(phi));
  const CriticalOutlet wedge = critical_outlet(HopperShape::wedge, theta, 0.3, law, weight),
                       cone = critical_outlet(HopperShape::cone, theta, 0.3, law, weight);
  EXPECT_NEAR(wedge.strength, strength, 1e-6 * strength);
  EXPECT_NEAR(wedge.width, (1 + 20.0 / 180) * strength / weight, 1e-9);
  EXPECT_NEAR(cone.width, (2 + 20.0 / 60) * strength / weight, 1e-9);
  EXPECT_NEAR(critical_outlet(HopperShape::wedge, theta, 0.3, law, 2 * weight).width, 0.5 * wedge.width, 1e-9);
  EXPECT_NEAR(rathole_diameter(law, 5000, weight), 4.3 * 0.5 * strength / weight, 1e-9);
}

TEST(HopperDesign, ARatholeHasTheStrengthOfItsMajorConsolidation) {
  // A flow function f_c = 0.555 kPa + 0.173 sigma_1 of 30 degrees: cement of the program, by f_c = 2 (a_0 + kappa s),
  // sigma_1 = (2 + kappa) s + a_0.
  CriticalStateParameters cement = powder(304, 0.189);
  cement.static_friction = std::tan(30 * degree);
  const double weight = 14509, strength = 555 + 0.173 * 33800;
  EXPECT_NEAR(rathole_diameter(cement, 33800, weight), 4.3 * std::tan(30 * degree) * strength / weight, 0.005);
  EXPECT_NEAR(rathole_diameter(cement, 33800, weight), 1.095, 0.01);
}

TEST(HopperDesign, TheOutletIsSoughtFromLowStressUpwards) {
  // Weak friction: under large loads delta falls below what any hopper's field bears, under low ones grains flow.
  auto law = powder(100, 0.1);
  law.static_friction = 0.3;
  const double weight = 1000 * gravity, theta = 54 * degree;
  EXPECT_TRUE(std::isinf(flow_factor(HopperShape::wedge, theta, 0.2, 15 * degree)));
  const CriticalOutlet outlet = critical_outlet(HopperShape::wedge, theta, 0.2, law, weight);
  EXPECT_LT(outlet.major, 200);
  EXPECT_NEAR(outlet.major, outlet.factor * outlet.strength, 1e-6 * outlet.major);
  EXPECT_LT(outlet.width, outlet.widest);
  EXPECT_TRUE(std::isfinite(outlet.widest)) << "delta falls with the load";
  law.static_friction = 0.9, law.consolidation_strength = 1;
  const CriticalOutlet none = critical_outlet(HopperShape::cone, 10 * degree, 0.2, law, weight);
  EXPECT_TRUE(std::isinf(none.width));
  EXPECT_EQ(none.major, 0) << "no stress of the search's end";
  EXPECT_EQ(none.strength, 0);
}

TEST(HopperDesign, TheOutletIsWhereFlowFunctionAndFlowFactorMeet) {
  const auto law = powder(100, 0.1);
  const double weight = 1000 * gravity, theta = 20 * degree;
  const CriticalOutlet outlet = critical_outlet(HopperShape::cone, theta, 0.3, law, weight);
  EXPECT_NEAR(outlet.major, outlet.factor * outlet.strength, 1e-6 * outlet.major);
  // Somewhere on the flow function: its closed form at the load that has this sigma_1.
  bool found = false;
  for (double load = 1; load < 1e5 && !found; load *= 1.0001) {
    const YieldLocus locus = steady_locus(law, load);
    found = std::abs(locus.major / outlet.major - 1) < 1e-4 && std::abs(locus.strength / outlet.strength - 1) < 1e-3;
  }
  EXPECT_TRUE(found);
}

TEST(HopperDesign, AStraightFlowFunctionThroughTheOriginFlowsOrArchesAnywhere) {
  const double weight = 1000 * gravity, theta = 20 * degree;
  EXPECT_EQ(critical_outlet(HopperShape::cone, theta, 0.3, powder(0, 0.02), weight).width, 0);
  CriticalStateParameters sticky = powder(0, 1);
  sticky.static_friction = 0.9;
  EXPECT_TRUE(std::isinf(critical_outlet(HopperShape::cone, 10 * degree, 0.2, sticky, weight).width));
  EXPECT_EQ(critical_outlet(HopperShape::cone, theta, 0.3, powder(0, 0), weight).width, 0);
}

TEST(HopperDesign, TheSteadyLocusIsThatOfTheShearTester) {
  auto parameters = powder(100, 0.2);
  parameters.dynamic_friction = 0.5, parameters.packing_slope = parameters.ageing_strength = 0;
  parameters.cohesion_strain = 2;
  const ShearTest test = shear_test(make_law(parameters, 2500), 4000, std::vector{0.25, 0.75});
  const YieldLocus locus = steady_locus(parameters, 4000);
  EXPECT_NEAR(locus.strength, test.locus.strength, 0.02 * locus.strength);
  EXPECT_NEAR(locus.major, test.locus.major, 0.03 * locus.major);
}

TEST(HopperDesign, Discharge) {
  const double theta = 20 * degree, width = 0.2, rho = 1000;
  const double coarse = johanson_discharge(HopperShape::cone, theta, width, 0, rho, gravity);
  EXPECT_NEAR(coarse, rho * 0.25 * std::numbers::pi * 0.04 * std::sqrt(0.2 * gravity / (4 * std::tan(theta))), 1e-9);
  EXPECT_NEAR(johanson_discharge(HopperShape::wedge, theta, width, 1, rho, gravity),
              rho * 0.2 * std::sqrt(0.2 * gravity / (2 * std::tan(theta))), 1e-9);
  EXPECT_EQ(johanson_discharge(HopperShape::cone, theta, width, 0, rho, gravity, width), 0) << "at the critical outlet";
  // Without drag: 4 v^2 sin(theta)/B = g; fine grains are slower, the finer the more.
  const double free = rho * 0.25 * std::numbers::pi * 0.04 * std::sqrt(0.2 * gravity / (4 * std::sin(theta)));
  EXPECT_NEAR(carleton_discharge(theta, width, rho, gravity, 2500, 0.1), free, 0.01 * free);
  const double sand = carleton_discharge(theta, width, rho, gravity, 2500, 200e-6);
  EXPECT_LT(sand, 0.7 * free);
  EXPECT_LT(carleton_discharge(theta, width, rho, gravity, 2500, 50e-6), 0.3 * sand);
}

}  // namespace
}  // namespace talus::granular
