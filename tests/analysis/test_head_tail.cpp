// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>

#include "analysis/head_tail.hpp"
#include "analysis/lattice.hpp"

namespace talus {
namespace {

using test::Points;

/// A tail of one layer from x = 0 to 60, then a head of six layers from 62 to 100; unit grains 2 apart. The layers of
/// the head, from below, have v_x = 9, 8, ..., 4; the tail has 1.
struct HeadAndTail {
  Points position;
  std::vector<Vector3> velocity;
  std::vector<double> radius;

  HeadAndTail() {
    for (int x = 0; x <= 100; x += 2)
      for (int layer = 0; layer < (x > 60 ? 6 : 1); ++layer) {
        position.push_back({double(x), 0, 1.0 + 2 * layer});
        velocity.push_back({x > 60 ? 9.0 - layer : 1.0, 0, 0});
      }
    radius.assign(position.size(), 1.0);
  }
};

TEST(HeadTail, ThicknessOfFrontAndRear) {
  const HeadAndTail flow;
  const ThicknessProfile profile = thickness_profile(flow.position, flow.radius, 1);
  // 151 grains: 5 % of the way along them is x = 15, in the column that ends at 12.
  EXPECT_EQ(profile.thickness.size(), 22u);
  EXPECT_EQ(profile.crest, 0u);
  EXPECT_EQ(profile.head_columns, 10u);  // the tenth ends at 60 and holds 62
  EXPECT_DOUBLE_EQ(profile.head_thickness(), 12);
  EXPECT_DOUBLE_EQ(profile.rear_thickness(), 2);
}

TEST(HeadTail, MotionRelativeToTheFront) {
  const HeadAndTail flow;
  const ThicknessProfile profile = thickness_profile(flow.position, flow.radius, 1);
  const HeadTailMotion motion = head_tail_motion(flow.position, flow.velocity, profile, 7);
  EXPECT_DOUBLE_EQ(motion.upper_head, 4.5 - 7);  // above 8: the layers at 9 and 11
  EXPECT_DOUBLE_EQ(motion.lower_head, 7.5 - 7);
  EXPECT_DOUBLE_EQ(motion.tail, 1 - 7);
}

TEST(HeadTail, TheHeadReachesFromTheFrontOverTheCrest) {
  // Heights 2, 8, 12, 6, 5, 12, 2, 2 of columns 4 long: the crest is the third, the fourth is half of it, the fifth
  // not.
  Points points;
  const std::vector<double> heights = {2, 8, 12, 6, 5, 12, 2, 2};
  for (std::size_t n = 0; n < heights.size(); ++n) points.push_back({-4.0 * double(n), 0, heights[n] - 1});
  const ThicknessProfile profile =
      thickness_profile(points, std::vector<double>(points.size(), 1.0), 1, {.stragglers = 0});
  EXPECT_EQ(profile.thickness, heights);
  EXPECT_EQ(profile.crest, 2u);
  EXPECT_EQ(profile.head_columns, 4u);
  EXPECT_DOUBLE_EQ(profile.rear_thickness(), 3.5);  // of 5, 12, 2, 2
}

TEST(HeadTail, OfAnOddNumberOfColumnsTheMiddleOneBelongsToTheFront) {
  const Points points = {{0, 0, 1}, {-4, 0, 11}, {-8, 0, 2}};
  const ThicknessProfile profile = thickness_profile(points, std::vector<double>(3, 1.0), 1, {.stragglers = 0});
  EXPECT_EQ(profile.crest, 1u);
  EXPECT_DOUBLE_EQ(profile.rear_thickness(), 3);
}

TEST(HeadTail, OfOneGrainAndOfNone) {
  const Points one = {{1, 2, 3}};
  const ThicknessProfile profile = thickness_profile(one, std::vector<double>{0.5}, 1);
  EXPECT_DOUBLE_EQ(profile.head_thickness(), 3.5);
  EXPECT_TRUE(std::isnan(profile.rear_thickness()));
  EXPECT_THROW(thickness_profile({}, {}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace talus
