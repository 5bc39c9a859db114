// SPDX-License-Identifier: Apache-2.0
#include "models/air/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace talus::air {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// A cavity of 1 m whose lid moves at 1 m/s, in air of 0.01 m^2/s.
ModelParameters cavity() {
  ModelParameters p;
  p.box = {.width = 1, .depth = 0.1, .height = 1};
  p.cell = 0.1;
  p.gas.viscosity = 0.01 * p.gas.density();
  p.gas.boundaries.kind[5] = FlowBoundary::no_slip;
  p.gas.wall_velocity[5] = {1, 0, 0};
  return p;
}

std::vector<std::string> warnings(const ModelParameters& p) {
  std::vector<std::string> names;
  for (const RegimeLine& line : regime_of_case(p))
    if (line.warning) names.push_back(line.quantity);
  return names;
}

TEST(RegimeOfAir, OfASlowFlowHasNoWarnings) {
  EXPECT_THAT(warnings(cavity()), IsEmpty());
}

TEST(RegimeOfAir, WarnsOfALidThatIsNearlyAsFastAsSound) {
  ModelParameters p = cavity();
  p.gas.wall_velocity[5] = {102, 0, 0};  // sound: 343 m/s
  EXPECT_THAT(warnings(p), IsEmpty());
  p.gas.wall_velocity[5] = {104, 0, 0};
  EXPECT_THAT(warnings(p), ElementsAre("Mach number of the case"));
  p.gas.wall_velocity[5] = {};
  p.start = {.flow = InitialFlow::taylor_green, .speed = 104};
  EXPECT_THAT(warnings(p), ElementsAre("Mach number of the case"));
}

TEST(RegimeOfAir, WarnsOfCentralConvectionInCoarseCells) {
  ModelParameters p = cavity();  // a cell has a Reynolds number of 10
  p.gas.upwind = 0;
  EXPECT_THAT(warnings(p), ElementsAre("Reynolds number of a cell"));
  p.cell = 1.0 / 51;
  EXPECT_THAT(warnings(p), IsEmpty());
}

/// The mean free path of air at 20 degrees C is 0.067 mm x 1 kPa/P.
TEST(RegimeOfAir, WarnsOfAirTooThinForItsBox) {
  ModelParameters p = cavity();
  p.gas.viscosity = 1.82e-5;
  p.gas.upwind = 1;
  p.gas.pressure = 0.7;
  EXPECT_THAT(warnings(p), IsEmpty());
  p.gas.pressure = 0.6;
  EXPECT_THAT(warnings(p), ElementsAre("Knudsen number"));
  for (const std::size_t face : {0, 1, 4, 5}) p.gas.boundaries.kind[face] = FlowBoundary::periodic;
  p.gas.wall_velocity[5] = {};
  EXPECT_THAT(warnings(p), IsEmpty());  // no two walls face each other
}

TEST(RegimeOfAir, KnowsTheSpeedThatADifferenceOfPressureDrives) {
  ModelParameters p = cavity();
  p.gas.wall_velocity[5] = {};
  p.gas.boundaries.kind[4] = p.gas.boundaries.kind[5] = FlowBoundary::open;
  p.gas.boundaries.pressure[4] = 10;
  EXPECT_NEAR(given_speed(p), std::sqrt(2 * 10 / p.gas.density()), 1e-12);
  p.gas.upwind = 0;
  EXPECT_THAT(warnings(p), ElementsAre("Reynolds number of a cell"));
  p.gas.boundaries.pressure[5] = 10;
  EXPECT_EQ(given_speed(p), 0);
}

/// Cells of 10 mm.
TEST(RegimeOfAir, TellsTheAirThatComesInThroughWholeCells) {
  const Grid grid{.count = {4, 1, 4}, .low = {}, .spacing = {0.01, 0.01, 0.01}};
  Parameters p;
  p.boundaries.kind[4] = FlowBoundary::inflow;
  p.wall_velocity[4] = {0, 0, 2};
  EXPECT_THAT(regime_of_faces(p, grid), Not(Contains(Field(&RegimeLine::quantity, HasSubstr("comes in")))));
  p.inflow_low = {0.01, 0, 0};
  const auto line = [&] { return regime_of_faces(p, grid).back(); };
  EXPECT_EQ(line().quantity, "air that comes in at the face floor");
  EXPECT_EQ(line().value, "0.0006 m3/s");
  EXPECT_FALSE(line().warning);
  p.inflow_low = {0.012, 0, 0};
  EXPECT_TRUE(line().warning) << "28 mm asked, 30 mm taken";
  p.inflow_low = {0.01, 0, 0.006};
  EXPECT_THAT(check_inflows(p, grid), SizeIs(1)) << "the floor is not in the box";
}

std::vector<std::string> wrong_keys(const Parameters& p) {
  std::vector<std::string> keys;
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  return keys;
}

TEST(CheckOfAir, AsksOfAnInflowThatItComesInAndGoesOut) {
  Parameters p;
  p.boundaries.kind[4] = FlowBoundary::inflow;
  p.wall_velocity[4] = {0, 0, 0.2};
  EXPECT_THAT(wrong_keys(p), IsEmpty());
  p.wall_velocity[4] = {0.1, 0, -0.2};
  EXPECT_THAT(wrong_keys(p), ElementsAre("air.floor_velocity", "air.floor_velocity"));
  p.wall_velocity[4] = {0, 0, 0.2};
  p.boundaries.kind[5] = FlowBoundary::no_slip;
  EXPECT_THAT(wrong_keys(p), ElementsAre("air.floor"));
  p.compressibility = Compressibility::isothermal;
  EXPECT_THAT(wrong_keys(p), IsEmpty());
  p.motion = Motion::frozen;
  EXPECT_THAT(wrong_keys(p), ElementsAre("air.floor"));
  p = {};
  p.boundaries.kind[1] = FlowBoundary::inflow;
  EXPECT_THAT(wrong_keys(p), ElementsAre("air.right_velocity"));
  p.wall_velocity[1] = {-0.2, 0, 0};
  EXPECT_THAT(wrong_keys(p), IsEmpty());
}

TEST(CheckOfAir, AsksOfTheBoxOfAnInflowThatItHoldsACell) {
  Parameters p;
  p.boundaries.kind[4] = FlowBoundary::inflow;
  const Grid grid{.count = {4, 1, 4}, .low = {}, .spacing = {0.01, 0.01, 0.01}};
  EXPECT_THAT(check_inflows(p, grid), IsEmpty());
  p.inflow_low = {0.011, 0, 0}, p.inflow_high = {0.019, 0.01, 0};
  EXPECT_THAT(check_inflows(p, grid), IsEmpty()) << "the middle at 15 mm; heights do not count";
  p.inflow_low = {0.016, 0, 0}, p.inflow_high = {0.024, 0.01, 0};
  ASSERT_EQ(check_inflows(p, grid).size(), 1u);
  EXPECT_EQ(check_inflows(p, grid)[0].key, "air.inflow_low");
}

}  // namespace
}  // namespace talus::air
