// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/gate_times.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace talus {
namespace {

TEST(GateTimes, AreAwayUntilItCloses) {
  GateTimes gate{.opens_after = 2, .closes_after = {}, .repeats_every = {}};
  EXPECT_FALSE(gate.is_away(1.9));
  EXPECT_TRUE(gate.is_away(2));
  EXPECT_FALSE(gate.closed_before(9));
  EXPECT_EQ(gate.time_away(1), 0);
  EXPECT_EQ(gate.time_away(9), 7);
  gate.closes_after = 3;
  EXPECT_FALSE(gate.is_away(3));
  EXPECT_EQ(gate.closed_before(9), 3);
  EXPECT_EQ(gate.time_away(2.5), 0.5);
  EXPECT_EQ(gate.time_away(9), 1);
  EXPECT_EQ(gate.time_away(4, 9), 0);
}

TEST(GateTimes, Repeat) {
  const GateTimes gate{.opens_after = 2, .closes_after = 3, .repeats_every = 3};
  EXPECT_TRUE(gate.is_away(5.5));
  EXPECT_FALSE(gate.is_away(6));
  EXPECT_FALSE(gate.is_away(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(gate.closed_before(7), 6);
  EXPECT_EQ(gate.time_away(4), 1);
  EXPECT_EQ(gate.time_away(8.5), 2.5);
}

}  // namespace
}  // namespace talus
