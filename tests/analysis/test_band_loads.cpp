// SPDX-License-Identifier: Apache-2.0
#include "analysis/band_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace talus {
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
