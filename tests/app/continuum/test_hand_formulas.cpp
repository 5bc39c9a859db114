// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/hand_formulas.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "app/continuum/wall_loads.hpp"
#include "physics/granular/enstad.hpp"
#include "physics/granular/silo.hpp"
#include "small_silo.hpp"

namespace talus::app {
namespace {

constexpr double weight = 0.6 * 2500 * 9.81, ratio = 0.5, friction = 0.3, top = 0.15;

TEST(DischargeByHand, OfAConeIsBeverloosTimesRoseAndTanakas) {
  continuum::Parameters p = small_silo();
  const double whole = granular::orifice_discharge(2 * p.vessel[1].lower_radius, 1500, 9.81, p.grains.diameter) *
                       granular::factor_of_cone(std::tan(std::numbers::pi / 6));
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p)), whole, 1e-12);
  for (continuum::VesselPart& v : p.vessel) v.centre = {0, 0};
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p)), 0.25 * whole, 1e-12) << "a quarter between planes of symmetry";
}

TEST(DischargeByHand, OfARectangularGateHasEdgesOnFourSides) {
  continuum::Parameters p = small_silo();
  p.vessel.erase(p.vessel.begin() + 1);
  p.vessel[1].shape = continuum::VesselShape::plate;
  p.vessel[1].corner = {0.04, 0.045, 0.09}, p.vessel[1].first_edge = {0.02, 0, 0},
  p.vessel[1].second_edge = {0, 0.01, 0};
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p)),
              granular::rectangular_discharge(0.02, 0.01, false, 1500, 9.81, p.grains.diameter), 1e-12);
}

/// A level gate in a box of 0.1 x 0.1 m.
continuum::Parameters gated(std::array<double, 3> corner, double width, double depth) {
  continuum::Parameters p;
  p.box.width = p.box.depth = 0.1, p.box.height = 0.25;
  continuum::VesselPart plate;
  plate.name = "gate", plate.shape = continuum::VesselShape::plate, plate.gate = true;
  plate.corner = corner, plate.first_edge = {width, 0, 0}, plate.second_edge = {0, depth, 0};
  p.vessel = {plate};
  return p;
}

TEST(DischargeByHand, OfARectangleIsTheSameTurnedByAQuarter) {
  const double along_x = discharge_by_hand(continuum::Layout(gated({0.035, 0.046, 0.1}, 0.03, 0.008)));
  EXPECT_NEAR(along_x, granular::rectangular_discharge(0.008, 0.03, false, 1500, 9.81, 200e-6), 1e-12);
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(gated({0.046, 0.035, 0.1}, 0.008, 0.03))), along_x, 1e-12);
}

TEST(DischargeByHand, OfAGateFromFaceToFaceIsThatOfAnEndlessSlot) {
  const double slot = granular::rectangular_discharge(0.02, 0.1, true, 1500, 9.81, 200e-6);
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(gated({0.04, -0.005, 0.1}, 0.02, 0.11))), slot, 1e-12)
      << "it sticks out";
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(gated({0, 0.01, 0.1}, 0.1, 0.02))), slot, 1e-12);
  continuum::Parameters p = gated({-0.01, 0, 0.1}, 0.02, 0.1);
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p)), 0.5 * slot, 1e-12) << "half of it, cut by its plane of symmetry";
  p = gated({0.04, -0.005, 0.1}, 0.02, 0.11);
  p.box.rear = FaceKind::open;
  EXPECT_LT(discharge_by_hand(continuum::Layout(p)), slot) << "it ends there";
}

TEST(DischargeByHand, OfSeveralOutletsIsTheirSum) {
  continuum::Parameters p = gated({0.01, 0.01, 0.1}, 0.03, 0.02);
  const double first = discharge_by_hand(continuum::Layout(p));
  continuum::VesselPart second = p.vessel[0];
  second.name = "second", second.corner = {0.06, 0.07, 0.1}, second.first_edge = {0.02, 0, 0};
  p.vessel.push_back(second);
  const auto outlets = continuum::outlets_of_vessel(p);
  ASSERT_EQ(outlets.size(), 2u);
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p), outlets[0]), first, 1e-12);
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p), outlets[1]),
              granular::rectangular_discharge(0.02, 0.02, false, 1500, 9.81, 200e-6), 1e-12);
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p)),
              discharge_by_hand(continuum::Layout(p), outlets[0]) + discharge_by_hand(continuum::Layout(p), outlets[1]),
              1e-12);
}

TEST(DischargeByHand, IsOfTheOutletsThatOpenFirst) {
  continuum::Parameters p = gated({0.02, 0.046, 0.1}, 0.02, 0.008);
  const double one = discharge_by_hand(continuum::Layout(p));
  p.vessel.push_back(p.vessel.front());
  p.vessel.back().name = "later", p.vessel.back().corner[0] = 0.06, p.vessel.back().opens_after = 2;
  EXPECT_DOUBLE_EQ(discharge_by_hand(continuum::Layout(p)), one);
  p.vessel.front().opens_after = 2;
  EXPECT_DOUBLE_EQ(discharge_by_hand(continuum::Layout(p)), 2 * one);
}

TEST(DischargeByHand, PassesNothingWhileGatesAreShut) {
  continuum::Parameters p = gated({0.02, 0.046, 0.1}, 0.02, 0.008);
  const double rate = discharge_by_hand(continuum::Layout(p));
  const auto time_of = [&](double mass) { return time_of_discharge_by_hand(continuum::Layout(p), mass); };
  EXPECT_NEAR(time_of(7 * rate), 7, 1e-9);
  p.vessel.front().opens_after = 1, p.vessel.front().closes_after = 3;
  EXPECT_NEAR(time_of(1.5 * rate), 2.5, 1e-9);
  EXPECT_TRUE(std::isnan(time_of(2.5 * rate))) << "it is shut for good";
  p.vessel.front().repeats_every = 5;
  EXPECT_NEAR(time_of(2.5 * rate), 6.5, 1e-9);
  EXPECT_NEAR(discharged_by_hand(continuum::Layout(p), 12), 5 * rate, 1e-9 * rate);
  p.vessel.push_back(p.vessel.front());
  p.vessel.back().name = "later", p.vessel.back().corner[0] = 0.06, p.vessel.back().opens_after = 2;
  EXPECT_NEAR(discharged_by_hand(continuum::Layout(p), 3), 3 * rate, 1e-9 * rate);
}

TEST(CriticalOutletByHand, OfASquarePyramidIsThatOfACone) {
  continuum::Parameters p = small_silo();
  granular::CriticalState::Parameters law;
  law.tensile_strength = 1000;
  p.law = law;
  const auto of_cone = critical_outlet_by_hand(continuum::Layout(p));
  ASSERT_TRUE(of_cone);
  continuum::VesselPart& hopper = p.vessel[1];
  hopper.shape = continuum::VesselShape::pyramid;
  hopper.lower_width = hopper.lower_depth = 2 * hopper.lower_radius;
  hopper.upper_width = hopper.upper_depth = 2 * hopper.upper_radius;
  p.vessel[2].shape = continuum::VesselShape::plate;
  p.vessel[2].corner = {0.05 - hopper.lower_radius, 0.05 - hopper.lower_radius, 0.06};
  p.vessel[2].first_edge = {2 * hopper.lower_radius, 0, 0}, p.vessel[2].second_edge = {0, 2 * hopper.lower_radius, 0};
  const auto of_pyramid = critical_outlet_by_hand(continuum::Layout(p));
  ASSERT_TRUE(of_pyramid);
  EXPECT_DOUBLE_EQ(of_pyramid->width, of_cone->width);
  hopper.lower_depth = 8 * hopper.lower_radius, hopper.upper_depth = 2 * hopper.upper_radius + 6 * hopper.lower_radius;
  p.box.depth = 0.4;
  p.vessel[2].corner[1] = 0.2 - 4 * hopper.lower_radius, p.vessel[2].second_edge[1] = 8 * hopper.lower_radius;
  const auto of_slot = critical_outlet_by_hand(continuum::Layout(p));
  ASSERT_TRUE(of_slot);
  EXPECT_LT(of_slot->width, 0.7 * of_cone->width) << "a wedge's";
}

TEST(DischargeByHand, OfASlitInAPlateIsThatOfAnEndlessOne) {
  continuum::Parameters p;
  p.box.width = 0.1, p.box.depth = 5e-3, p.box.height = 0.25;
  p.plate.height = 0.1, p.plate.slit_left = 0.03, p.plate.slit_right = 0.07;
  const double whole = granular::rectangular_discharge(0.04, 5e-3, true, 1500, 9.81, p.grains.diameter);
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p)), whole, 1e-12);
  EXPECT_NEAR(whole, 0.19, 0.01) << "the paper's hopper";
  p.plate.slit_left = 0, p.plate.slit_right = 0.02;
  EXPECT_NEAR(discharge_by_hand(continuum::Layout(p)), 0.5 * whole, 1e-12)
      << "half of it, cut by its plane of symmetry";
  p.plate.slit_left.reset(), p.plate.slit_right.reset();
  EXPECT_EQ(discharge_by_hand(continuum::Layout(p)), 0);
}

TEST(InternalFrictionByHand, IsTheLawsInPlaneStrain) {
  continuum::Parameters p = small_silo();
  EXPECT_DOUBLE_EQ(internal_friction_by_hand(p), std::numbers::pi / 6) << "a law without a friction of its own";
  p.law = granular::CriticalState::Parameters{.static_friction = std::tan(std::numbers::pi / 6)};
  EXPECT_NEAR(internal_friction_by_hand(p) * 180 / std::numbers::pi, 35.26, 0.01);
  EXPECT_NEAR(internal_friction_by_hand(p, granular::FrictionTest::shear_plane) * 180 / std::numbers::pi, 30, 0.02);
  EXPECT_DOUBLE_EQ(mass_flow_half_angle_by_hand(continuum::Layout(p)),
                   granular::mass_flow_half_angle(friction, internal_friction_by_hand(p)));
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(p));
  const double above = granular::janssen_stress(weight, 0.06 / (4 * friction * ratio), top - 0.09);
  EXPECT_NEAR(pressure_by_hand(continuum::Layout(p), bands[10], ratio, top, 0.09).in_flow,
              granular::cone_in_flow(std::numbers::pi / 6, friction, internal_friction_by_hand(p)).ratio * above, 1e-6);
  p.law = granular::DruckerPrager::Parameters{.friction = 1.5};
  EXPECT_DOUBLE_EQ(internal_friction_by_hand(p), std::numbers::pi / 2);
}

TEST(PressureRatioAtRest, IsThatOfTheModuliBelowYield) {
  continuum::Parameters p = small_silo();
  EXPECT_TRUE(std::isnan(pressure_ratio_at_rest(continuum::Layout(p))));
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 1e6, law.shear_modulus = 0.375e6;
  p.law = law;
  EXPECT_NEAR(pressure_ratio_at_rest(continuum::Layout(p)), 0.5, 0.01) << "wheat: 1 - sin 30 degrees";
  law.shear_modulus = 0.6e6;
  p.law = law;
  EXPECT_NEAR(pressure_ratio_at_rest(continuum::Layout(p)), 0.439, 0.02)
      << "of a bed between smooth walls; 0.33 of B, G";
  law.static_friction = 0.8;
  p.law = law;
  EXPECT_NEAR(pressure_ratio_at_rest(continuum::Layout(p)), 1 / 3.0, 0.01);
  law.bulk_modulus = 10, law.shear_modulus = 6;
  p.law = law;
  EXPECT_NO_THROW(pressure_ratio_at_rest(continuum::Layout(p))) << "far too soft";
}

TEST(MassFlowByHand, IsOfTheConeAndItsWall) {
  continuum::Parameters p = small_silo();
  EXPECT_DOUBLE_EQ(mass_flow_half_angle_by_hand(continuum::Layout(p)),
                   granular::mass_flow_half_angle(friction, std::numbers::pi / 6));
  p.vessel[1].friction = 0.1;
  EXPECT_DOUBLE_EQ(mass_flow_half_angle_by_hand(continuum::Layout(p)),
                   granular::mass_flow_half_angle(0.1, std::numbers::pi / 6));
  p.vessel.erase(p.vessel.begin() + 1);
  EXPECT_TRUE(std::isnan(mass_flow_half_angle_by_hand(continuum::Layout(p))));
}

TEST(PressureByHand, IsJanssensAndWalkers) {
  const continuum::Parameters p = small_silo();
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(p));
  const double length = 0.06 / (4 * friction * ratio);
  const PressureByHand upright = pressure_by_hand(continuum::Layout(p), bands[2], ratio, top, 0.11);
  EXPECT_NEAR(upright.at_rest, ratio * granular::janssen_stress(weight, length, top - 0.11), 1e-9);
  EXPECT_EQ(upright.at_rest, upright.in_flow);
  EXPECT_TRUE(std::isnan(pressure_by_hand(continuum::Layout(p), bands[7], ratio, top, 0.16).at_rest))
      << "above the bed";
  // At the cone's top the bed above is all that it bears.
  const double above = granular::janssen_stress(weight, length, top - 0.09), angle = continuum::half_turn / 6;
  const PressureByHand cone = pressure_by_hand(continuum::Layout(p), bands[10], ratio, top, 0.09);
  EXPECT_NEAR(cone.at_rest, granular::cone_at_rest(angle, friction).ratio * above, 1e-6);
  EXPECT_NEAR(cone.in_flow, granular::cone_in_flow(angle, friction, 30 * continuum::half_turn / 180).ratio * above,
              1e-6);
  EXPECT_TRUE(std::isnan(pressure_by_hand(continuum::Layout(p), bands.back(), ratio, top, 0.06).at_rest))
      << "no formula of the lid of a cone";
}

TEST(PressureByHand, OfAConeIsEnstadsToo) {
  continuum::Parameters p = small_silo();
  p.walls.coefficient = 0.15;
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(p));
  const double angle = continuum::half_turn / 6, apex = 0.09 - 0.03 / std::tan(angle);
  const auto arcs = granular::arc_bearing(2, angle, 0.15, angle);
  ASSERT_TRUE(arcs);
  const double above = granular::janssen_stress(weight, 0.06 / (4 * 0.15 * ratio), top - 0.09);
  const auto in_flow = [&](std::size_t band, double height) {
    return pressure_by_hand(continuum::Layout(p), bands[band], ratio, top, height).in_flow_enstad;
  };
  EXPECT_NEAR(in_flow(10, 0.08), granular::arc_pressure(*arcs, weight, 0.08 - apex, 0.09 - apex, above), 1e-6);
  EXPECT_TRUE(std::isnan(in_flow(2, 0.11))) << "upright walls";
  p.walls.coefficient = 1;
  EXPECT_TRUE(std::isnan(in_flow(10, 0.08))) << "arcs of half a circle";
}

TEST(PressureByHand, OfRingsOfOtherFrictionCarriesTheStressOfThoseAbove) {
  continuum::Parameters p = small_silo();
  p.vessel.push_back(p.vessel[0]);
  p.vessel[0].top = p.vessel.back().bottom = 0.12;
  p.vessel.back().name = "upper", p.vessel.back().friction = 0.1;
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(p));
  const auto length = [](double mu) { return 0.06 / (4 * mu * ratio); };
  const double above = granular::janssen_stress(weight, length(0.1), top - 0.12);
  EXPECT_NEAR(pressure_by_hand(continuum::Layout(p), bands[0], ratio, top, 0.1).at_rest,
              ratio * granular::janssen_stress(weight, length(0.3), 0.02, above), 1e-9);
  EXPECT_NEAR(pressure_by_hand(continuum::Layout(p), bands.back(), ratio, top, 0.13).at_rest,
              ratio * granular::janssen_stress(weight, length(0.1), top - 0.13), 1e-9);
}

TEST(PressureByHand, IsNotThatOfUprightWallsWhereTheyLie) {
  continuum::Parameters p = small_silo();
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(p));
  for (continuum::VesselPart& wall : p.vessel) wall.along = continuum::Along::y;
  for (const std::size_t band : {2, 10})
    EXPECT_TRUE(std::isnan(pressure_by_hand(continuum::Layout(p), bands[band], ratio, top, 0.1).at_rest));
}

TEST(PressureByHand, SmoothWallsLeaveTheWholeWeightToTheFloor) {
  continuum::Parameters p = small_silo();
  p.walls.friction = continuum::Friction::none;
  p.vessel[2].height = 0.09, p.vessel[2].radius = 0.03;
  p.vessel.erase(p.vessel.begin() + 1);
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(p));
  EXPECT_NEAR(pressure_by_hand(continuum::Layout(p), bands.back(), ratio, top, 0.09).at_rest, weight * (top - 0.09),
              1e-9);
}

}  // namespace
}  // namespace talus::app
