// SPDX-License-Identifier: Apache-2.0
#include "analysis/wall_loads.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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
}  // namespace talus
