// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/yuu2011_air.hpp"

#include <gtest/gtest.h>

namespace talus::app {
namespace {

/// 4 x 2 x 5 cells of 10 x 5 x 20 mm from x = 20 mm on; the pressure names the cell: i + 10 j + 100 k Pa.
GridSnapshot numbered() {
  GridSnapshot air{
      .time = 0, .step = 0, .count = {4, 2, 5}, .low = {20e-3, 0, 0}, .spacing = {10e-3, 5e-3, 20e-3}, .columns = {}};
  std::vector<double> pressure(air.cells());
  std::vector<Vector3> velocity(air.cells());
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 4; ++i) {
        pressure[air.index(i, j, k)] = i + 10 * j + 100 * k;
        velocity[air.index(i, j, k)] = {1, 1, 0.5 * i - k};
      }
  air.columns.push_back({"pressure", "Pa", pressure});
  air.columns.push_back({"velocity", "m/s", velocity});
  return air;
}

TEST(AirProfile, GoesThroughTheMiddleOfTheDepth) {
  const AirProfile across = air_along_x(numbered(), 50e-3);
  ASSERT_EQ(across.place.size(), 4u);
  EXPECT_NEAR(across.place[0], 25, 1e-12);
  EXPECT_NEAR(across.place[3], 55, 1e-12);
  EXPECT_EQ(across.pressure, (std::vector<double>{210, 211, 212, 213}));
  EXPECT_EQ(across.velocity, (std::vector<double>{-2, -1.5, -1, -0.5}));

  const AirProfile up = air_along_z(numbered(), 31e-3);
  EXPECT_NEAR(up.place[4], 90, 1e-12);
  EXPECT_EQ(up.pressure, (std::vector<double>{11, 111, 211, 311, 411}));
}

}  // namespace
}  // namespace talus::app
