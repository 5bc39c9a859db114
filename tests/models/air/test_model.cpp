// SPDX-License-Identifier: Apache-2.0
/// Air alone, as a case file has it.
#include "models/air/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace talus::air {
namespace {

ModelParameters square(int cells) {
  ModelParameters p;
  p.box = {.width = 1, .depth = 1.0 / cells, .height = 1};
  p.cell = 1.0 / cells;
  p.gas.viscosity = 0.01 * p.gas.density();
  p.gas.upwind = 0;
  p.gas.boundaries.kind.fill(FlowBoundary::periodic);
  return p;
}

std::map<std::string, double> after(const ModelParameters& p, double end, int threads = 1) {
  ThreadTeam team(threads);
  AirModel model(p);
  model.begin(team);
  while (model.state().time < end) model.advance(team);
  std::map<std::string, double> values;
  for (const NamedValue& value : model.totals()) values[value.name] = value.value;
  return values;
}

/// In a box that is higher than wide, so that the two wave numbers differ.
TEST(AirModel, TaylorGreenVorticesDecayAsTheExactOnesWithSecondOrder) {
  const auto error = [](int cells, double step) {
    ModelParameters p = square(cells);
    p.box.height = 1.5;
    p.start.flow = InitialFlow::taylor_green;
    p.gas.max_step = step;
    p.gas.tolerance = 1e-9;
    const auto values = after(p, 0.2);
    EXPECT_NEAR(values.at("taylor_green_energy"), 1, 0.05 * 256 / cells / cells);
    return values.at("taylor_green_error");
  };
  EXPECT_NEAR(std::log2(error(16, 8e-3) / error(32, 4e-3)), 2, 0.25);
}

TEST(AirModel, LidDrivenCavityComesNearTheSpectralOneOnACoarseGrid) {
  ModelParameters p = square(24);  // of second order: 5.4 % off on 20 cells, 3.8 % on 24
  p.gas.boundaries.kind = {FlowBoundary::no_slip,  FlowBoundary::no_slip, FlowBoundary::periodic,
                           FlowBoundary::periodic, FlowBoundary::no_slip, FlowBoundary::no_slip};
  p.gas.wall_velocity[5] = {1, 0, 0};
  p.gas.max_step = 25e-3;
  const auto values = after(p, 12.5);
  EXPECT_NEAR(values.at("middle_u_min") / -0.2140424, 1, 0.05);
  EXPECT_NEAR(values.at("middle_w_min") / -0.2538030, 1, 0.05);
  EXPECT_NEAR(values.at("middle_w_max") / 0.1795728, 1, 0.05);
}

TEST(AirModel, GoesOnFromACheckpointToTheSameBits) {
  ModelParameters p = square(8);
  p.start.flow = InitialFlow::taylor_green;
  p.gas.max_step = 5e-3;
  ThreadTeam team(1);
  AirModel whole(p);
  whole.begin(team);
  for (int n = 0; n < 5; ++n) whole.advance(team);
  AirModel resumed(p);
  resumed.mutable_state() = whole.state();
  resumed.resume(team);
  for (int n = 0; n < 5; ++n) whole.advance(team), resumed.advance(team);
  EXPECT_EQ(whole.state().flow.velocity, resumed.state().flow.velocity);
  EXPECT_EQ(whole.state().time, resumed.state().time);
}

TEST(AirModel, CheckNamesWallsThatCannotMoveAndVorticesThatDoNotFit) {
  ModelParameters p = square(8);
  p.start.flow = InitialFlow::taylor_green;
  EXPECT_TRUE(check(p).empty());
  p.gas.boundaries.kind[4] = p.gas.boundaries.kind[5] = FlowBoundary::no_slip;
  p.gas.wall_velocity[5] = {1, 0, 0.1};
  p.gas.wall_velocity[0] = {0, 0, 1};
  std::vector<std::string> keys;
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  EXPECT_THAT(keys, testing::UnorderedElementsAre("air.top_velocity", "air.left_velocity", "air.floor"));
}

}  // namespace
}  // namespace talus::air
