// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <gtest/gtest.h>

namespace talus {
namespace {

TEST(AvalancheRun, FromTheRecordsOfTheFront) {
  // 2 mm and 4 m/s make a/v_s 0.5 ms; the front runs at 80 m/s = 20 v_s.
  const AvalancheScales scales{0.002, 4};
  Curve front;
  for (int n = 0; n <= 110; ++n) {
    front.time.push_back(n * 1e-5);
    front.value.push_back(7 + 80 * n * 1e-5);
  }
  const AvalancheRun run = avalanche_run(front, 1e-3, scales);
  ASSERT_EQ(run.front_speed.time.size(), 8u) << "the run ends at 2 a/v_s, the records a little later";
  EXPECT_DOUBLE_EQ(run.front_speed.time.back(), 2);
  for (const double v : run.front_speed.value) EXPECT_NEAR(v, 20, 1e-9);
}

TEST(AvalancheRun, HasNoFrontSpeedWhereNoWindowFits) {
  const AvalancheScales scales{0.002, 4};  // a window is 0.125 ms
  const Curve front{{0, 1e-4, 2e-4}, {0, 0.01, 0.02}};
  EXPECT_EQ(avalanche_run(front, 2e-4, scales).front_speed.time.size(), 1u);
  EXPECT_TRUE(avalanche_run(front, 1e-4, scales).front_speed.time.empty());
  EXPECT_EQ(avalanche_run(front, 5e-4, scales).front_speed.time.size(), 1u) << "no grain was a front at the end";
}

}  // namespace
}  // namespace talus
