// SPDX-License-Identifier: Apache-2.0
/// Air that comes in through a face at a given velocity.
#include <gtest/gtest.h>

#include <cmath>

#include "flow_case.hpp"

namespace talus::air {
namespace {

constexpr double h = 1.25e-3;

/// Between smooth walls, in through the floor and out at the top.
Parameters upwards(double velocity) {
  Parameters p;
  p.boundaries = all(FlowBoundary::free_slip);
  p.boundaries.kind[4] = FlowBoundary::inflow, p.boundaries.kind[5] = FlowBoundary::open;
  p.wall_velocity[4] = {0, 0, velocity};
  return p;
}

TEST(AirInflow, FillsAnEmptyChannelWithItsVelocityWithoutPressure) {
  for (const bool from_above : {false, true}) {
    Parameters p = upwards(0.5);
    if (from_above) std::swap(p.boundaries.kind[4], p.boundaries.kind[5]), p.wall_velocity[5] = {0, 0, -0.5};
    if (from_above) p.wall_velocity[4] = {};
    Case c({.count = {4, 2, 8}, .low = {}, .spacing = {h, h, h}}, p);
    c.begin();
    c.advance(1e-3, 20);
    for (int k = 0; k <= 8; ++k) EXPECT_NEAR(c.state.velocity[2][c.grid.index(1, 1, k)], from_above ? -0.5 : 0.5, 1e-6);
    for_each_cell(c.grid, [&](int, int, int, std::size_t n) { EXPECT_NEAR(c.state.pressure[n], 0, 1e-4); });
    EXPECT_LT(c.flow.max_divergence(c.solids, c.state), 1e-4);
  }
}

/// As in PressureDropOfAFixedBedIsThatOfTheDragLaw, where pressures give the flow.
TEST(AirInflow, LosesInAFixedBedThePressureOfTheDragLawAndLiftsItsLowestGrainsToo) {
  for (const auto& [law, formulation, drop] : fixed_beds) {
    Parameters p = upwards(0.01);
    p.drag = law, p.formulation = formulation;
    Case c({.count = {2, 2, 16}, .low = {}, .spacing = {h, h, h}}, p);
    c.set_solids(0, 16, 0.6, {});
    c.begin();
    c.advance(100e-6, 40);
    const double gradient =
        (c.state.pressure[c.grid.index(0, 0, 12)] - c.state.pressure[c.grid.index(0, 0, 3)]) / (9 * h);
    EXPECT_NEAR(gradient, -drop, 5e-3 * drop);
    const double lift = 0.6 * c.impulse[2][c.grid.index(1, 0, 8)] / 100e-6;
    EXPECT_NEAR(lift, drop, 5e-3 * drop);
    EXPECT_NEAR(0.6 * c.impulse[2][c.grid.index(1, 0, 0)] / 100e-6, lift, 1e-6 * lift);
    EXPECT_NEAR(c.state.drag[2][c.grid.index(1, 0, 0)], c.state.drag[2][c.grid.index(1, 0, 8)], 1e-6 * lift);
  }
}

TEST(AirInflow, ComesThroughItsPartOfTheFaceAlone) {
  Parameters p = upwards(2);
  p.inflow_low = {2 * h, 0, -h}, p.inflow_high = {4 * h, h, h};
  Case c({.count = {6, 2, 12}, .low = {}, .spacing = {h, h, h}}, p);
  c.begin();
  c.advance(50e-6, 100);
  double out = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 6; ++i) {
      const bool is_in = (i == 2 || i == 3) && j == 0;
      EXPECT_EQ(c.state.velocity[2][c.grid.index(i, j, 0)], is_in ? 2 : 0);
      out += c.state.velocity[2][c.grid.index(i, j, 12)];
    }
  EXPECT_NEAR(out, 2 * 2, 1e-4);
  EXPECT_GT(c.state.velocity[2][c.grid.index(2, 0, 2)], 3 * c.state.velocity[2][c.grid.index(0, 1, 2)]) << "a jet";
}

TEST(AirInflow, WaitsUntilItIsLetIn) {
  Case c({.count = {2, 2, 6}, .low = {}, .spacing = {h, h, h}}, upwards(0.5));
  c.flow.let_in(false);
  c.begin();
  c.advance(1e-3, 3);
  EXPECT_EQ(c.state.velocity[2][c.grid.index(0, 0, 3)], 0);
  c.flow.let_in(true);
  c.advance(1e-3, 20);
  EXPECT_NEAR(c.state.velocity[2][c.grid.index(0, 0, 3)], 0.5, 1e-6);
}

TEST(AirInflow, TakesNoVelocityAlongTheFaceWithIt) {
  // Air that slides along the floor at first is slowed by what comes in, as by nothing else: momentum is conserved.
  Parameters p = upwards(1);
  p.viscosity = 1e-18;
  p.boundaries.kind[0] = p.boundaries.kind[1] = p.boundaries.kind[2] = p.boundaries.kind[3] = FlowBoundary::periodic;
  Case c({.count = {4, 2, 8}, .low = {}, .spacing = {h, h, h}}, p);
  c.set_velocity([](const Vector3&) { return Vector3{0.3, 0, 1}; });
  c.begin();
  const double before = c.momentum().x, dt = 50e-6;
  c.advance(dt);
  const double area = 4 * h * 2 * h, leaves = p.density() * 1 * 0.3 * area * dt;
  EXPECT_NEAR(c.momentum().x - before, -leaves, 0.02 * leaves);
}

}  // namespace
}  // namespace talus::air
