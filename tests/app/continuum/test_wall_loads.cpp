// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/wall_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/granular/silo_pressure.hpp"

namespace talus::app {
namespace {

constexpr double weight = 0.6 * 2500 * 9.81, ratio = 0.5, friction = 0.3, top = 0.15;

/// A cone of 30 degrees under a cylinder of 30 mm, from 60 and 90 mm on, with a lid.
continuum::Parameters silo() {
  continuum::Parameters p;
  p.box.width = p.box.depth = 0.1, p.box.height = 0.2;
  p.bed.spacing = 2.5e-3;
  p.walls.coefficient = friction;
  continuum::VesselPart cylinder, cone, lid;
  cylinder.name = "cylinder", cylinder.radius = 0.03, cylinder.bottom = 0.09, cylinder.top = 0.17;
  cone.name = "cone", cone.shape = continuum::VesselShape::cone;
  cone.upper_radius = 0.03, cone.lower_radius = 0.03 - 0.03 * std::tan(continuum::half_turn / 6);
  cone.bottom = 0.06, cone.top = 0.09;
  lid.name = "lid", lid.shape = continuum::VesselShape::disc, lid.radius = cone.lower_radius, lid.height = 0.06;
  lid.gate = true;
  p.vessel = {cylinder, cone, lid};
  return p;
}

TEST(WallLoads, BandsAreThoseOfTheWalls) {
  const std::vector<BandOfWall> bands = bands_of(silo());
  ASSERT_EQ(bands.size(), 8u + 3u + 1u);
  EXPECT_EQ(bands[0].name, "cylinder.1");
  EXPECT_TRUE(bands[0].is_upright());
  EXPECT_NEAR(bands[8].sine, 0.5, 1e-3) << "the cone";
  EXPECT_NEAR(bands.back().area, continuum::half_turn * std::pow(0.03 - 0.03 * std::tan(continuum::half_turn / 6), 2),
              1e-9);
}

TEST(WallLoads, ByHandAreJanssensAndWalkersPressures) {
  const continuum::Parameters p = silo();
  const std::vector<BandOfWall> bands = bands_of(p);
  const double length = 0.06 / (4 * friction * ratio);
  const PressureByHand upright = pressure_by_hand(p, bands[2], ratio, top, 0.11);
  EXPECT_NEAR(upright.at_rest, ratio * granular::janssen_stress(weight, length, top - 0.11), 1e-9);
  EXPECT_EQ(upright.at_rest, upright.in_flow);
  EXPECT_TRUE(std::isnan(pressure_by_hand(p, bands[7], ratio, top, 0.16).at_rest)) << "above the bed";
  // At the cone's top the bed above is all that it bears.
  const double above = granular::janssen_stress(weight, length, top - 0.09), angle = continuum::half_turn / 6;
  const PressureByHand cone = pressure_by_hand(p, bands[10], ratio, top, 0.09);
  EXPECT_NEAR(cone.at_rest, granular::cone_at_rest(angle, friction).ratio * above, 1e-6);
  EXPECT_NEAR(cone.in_flow, granular::cone_in_flow(angle, friction, 30 * continuum::half_turn / 180).ratio * above,
              1e-6);
  EXPECT_TRUE(std::isnan(pressure_by_hand(p, bands.back(), ratio, top, 0.06).at_rest))
      << "no formula of the lid of a cone";
}

TEST(WallLoads, SmoothWallsLeaveTheWholeWeightToTheFloor) {
  continuum::Parameters p = silo();
  p.walls.friction = continuum::Friction::none;
  p.vessel[2].height = 0.09, p.vessel[2].radius = 0.03;
  p.vessel.erase(p.vessel.begin() + 1);
  const std::vector<BandOfWall> bands = bands_of(p);
  EXPECT_NEAR(pressure_by_hand(p, bands.back(), ratio, top, 0.09).at_rest, weight * (top - 0.09), 1e-9);
}

}  // namespace
}  // namespace talus::app
