// SPDX-License-Identifier: Apache-2.0
#include "app/case/run_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace talus::app {
namespace {

using ::testing::ElementsAre;

TEST(ChosenSnapshots, SpanTheRunFromTheOpeningToItsEnd) {
  std::vector<double> time;
  for (int n = -2; n <= 6; ++n) time.push_back(0.1 * n);
  EXPECT_THAT(chosen_snapshots(time, 4), ElementsAre(2, 4, 6, 8)) << "0, 0.2, 0.4 and 0.6 s";
  EXPECT_THAT(chosen_snapshots(time, 2), ElementsAre(2, 8));
  EXPECT_THAT(chosen_snapshots({-0.3, -0.2, -0.1}, 3), ElementsAre(0, 1, 2)) << "a gate that never opens";
  EXPECT_THAT(chosen_snapshots({0, 1}, 4), ElementsAre(0, 1)) << "each once";
  EXPECT_TRUE(chosen_snapshots({}, 4).empty());
}

}  // namespace
}  // namespace talus::app
