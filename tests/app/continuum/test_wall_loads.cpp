// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/wall_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_silo.hpp"

namespace talus::app {
namespace {

TEST(WallLoads, BandsAreThoseOfTheWalls) {
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(small_silo()));
  ASSERT_EQ(bands.size(), 8u + 3u + 1u);
  EXPECT_EQ(bands[0].name, "cylinder.1");
  EXPECT_TRUE(bands[0].is_upright());
  EXPECT_NEAR(bands[8].sine, 0.5, 1e-3) << "the cone";
  EXPECT_NEAR(bands.back().area, continuum::half_turn * std::pow(0.03 - 0.03 * std::tan(continuum::half_turn / 6), 2),
              1e-9);
}

}  // namespace
}  // namespace talus::app
