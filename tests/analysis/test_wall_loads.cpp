// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/wall_loads.hpp"

namespace talus {

namespace {

/// A bed of weight 2 N on a floor and, by friction, side walls; its momentum grows by what is left.
Series bed(double floor, double side, double push) {
  Series s;
  const auto column = [&](const char* name, double per_second) {
    s.names.push_back(name);
    s.units.push_back("N s");
    s.columns.emplace_back();
    for (int n = 0; n <= 1000; ++n) s.columns.back().push_back(per_second * 1e-3 * n);
  };
  column("time", 1);
  column("momentum_x", 0);
  column("momentum_y", 0);
  column("momentum_z", -2 + floor + 2 * side);
  column("impulse_gravity_x", 0);
  column("impulse_gravity_y", 0);
  column("impulse_gravity_z", -2);
  for (const char* name : {"impulse_damping_x", "impulse_damping_y", "impulse_damping_z"}) column(name, 0);
  column("impulse_left_x", -push);
  column("impulse_left_y", 0);
  column("impulse_left_z", -side);
  column("impulse_right_x", push);
  column("impulse_right_y", 0);
  column("impulse_right_z", -side);
  column("impulse_floor_x", 0);
  column("impulse_floor_y", 0);
  column("impulse_floor_z", -floor);
  return s;
}

TEST(WallLoads, ForcesAreImpulsesOverTime) {
  const Series s = bed(1.4, 0.3, 5);
  EXPECT_THAT(walls_of(s), testing::ElementsAre("left", "right", "floor"));
  EXPECT_NEAR(wall_force(s, "left", 0.5, 0.52).x, -5, 1e-9);
  EXPECT_NEAR(wall_force(s, "right", 0.5, 0.52).x, 5, 1e-9);
  EXPECT_NEAR(wall_force(s, "floor", 0.98, 1.0).z, -1.4, 1e-9);
  EXPECT_NEAR(weight_balance_error(s, 2, 0.98, 1.0), 0, 1e-9);
  EXPECT_NEAR(weight_balance_error(s, 1.9, 0.98, 1.0), 2 / 1.9 - 1, 1e-9);
  EXPECT_TRUE(std::isnan(weight_balance_error(s, 2, 0.99, 1.01)));
  EXPECT_THROW(wall_force(s, "plate", 0, 1), std::out_of_range);
}

TEST(WallLoads, MomentumThatNoImpulseExplainsIsAnError) {
  Series s = bed(1.0, 0.2, 5);
  EXPECT_NEAR(momentum_error(s), 0, 1e-12);
  s.columns[3].back() += 0.01;  // momentum_z; gravity gave 2 N s
  EXPECT_NEAR(momentum_error(s), 0.005, 1e-12);
  s.columns[9].back() -= 0.01;  // impulse_damping_z: the damping took it
  EXPECT_NEAR(momentum_error(s), 0, 1e-12);
}

}  // namespace

namespace {

/// 0.1 s at rest under 6 N, then 4 N, but 9 N from 0.05 to 0.06 s after the gate opened; half as much downwards.
Series pressed() {
  Series series{.names = {"time", "normal_impulse_wall_2", "shear_impulse_wall_2", "normal_impulse_floor"},
                .units = {"s", "N s", "N s", "N s"},
                .columns = {{}, {}, {}, {}}};
  double impulse = 0;
  for (int n = 0; n <= 3000; ++n) {
    const double t = 1e-4 * n, since = t - 0.1;
    series.columns[0].push_back(t);
    series.columns[1].push_back(impulse);
    series.columns[2].push_back(0.5 * impulse);
    series.columns[3].push_back(2 * impulse);
    impulse += 1e-4 * (since < -1e-9 ? 6 : since > 0.05 - 1e-9 && since < 0.06 - 1e-9 ? 9 : 4);
  }
  return series;
}

TEST(BandLoads, AreForcesOverTheAreaAtRestInFlowAndAtTheirLargest) {
  const BandOfWall band{.name = "wall_2", .patch = 0, .low = 0, .high = 1, .area = 2, .sine = 0};
  const BandLoad load = load_of(pressed(), band, 0.1, 0.1, 0.2, 20e-3);
  EXPECT_NEAR(load.pressure_at_rest, 3, 1e-9);
  EXPECT_NEAR(load.shear_at_rest, 1.5, 1e-9);
  EXPECT_NEAR(load.pressure_in_flow, 2, 1e-9);
  EXPECT_NEAR(load.shear_in_flow, 1, 1e-9);
  EXPECT_NEAR(load.pressure_largest, 4.5, 1e-6);
  EXPECT_NEAR(load.time_of_largest, 0.055, 1e-9);
}

TEST(BandLoads, OfAGateAreWhileItIsThere) {
  BandOfWall gate{.name = "wall_2", .patch = 0, .low = 0, .high = 1, .area = 2, .sine = 0};
  gate.gate = {.opens_after = 0.12, .closes_after = 0.17, .repeats_every = {}};
  EXPECT_NEAR(load_of(pressed(), gate, 0.1, 0.1, 0.2, 20e-3).pressure_in_flow, 4, 1e-9) << "for half of the time";
  gate.gate->closes_after = std::nullopt;
  EXPECT_TRUE(std::isnan(load_of(pressed(), gate, 0.1, 0.15, 0.2, 20e-3).pressure_in_flow));
  EXPECT_NEAR(load_of(pressed(), gate, 0.1, 0.15, 0.2, 20e-3).pressure_at_rest, 3, 1e-9);
}

TEST(BandLoads, ALevelBandHasNoShearAndARunWithoutRestNoLoadAtRest) {
  const BandOfWall floor{.name = "floor", .patch = 1, .low = 0, .high = 0, .area = 4, .sine = 1};
  const BandLoad load = load_of(pressed(), floor, 0, 0.25, 0.3, 20e-3);
  EXPECT_TRUE(std::isnan(load.pressure_at_rest));
  EXPECT_TRUE(std::isnan(load.shear_in_flow));
  EXPECT_NEAR(load.pressure_in_flow, 2, 1e-9);
  EXPECT_TRUE(curves_of(pressed(), floor, 0.1, 20e-3).shear.time.empty());
  const Curve pressure = curves_of(pressed(), floor, 0.1, 20e-3).pressure;
  EXPECT_NEAR(pressure.value.front(), 3, 1e-9);
  EXPECT_NEAR(pressure.time.front(), -0.095, 1e-9);
}

}  // namespace

}  // namespace talus
