// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "analysis/displacement.hpp"
#include "analysis/head_tail.hpp"
#include "analysis/lattice.hpp"
#include "analysis/vortices.hpp"

namespace talus {
namespace {

using test::Points;

TEST(VelocityGradient, IsExactForAnAffineField) {
  const Points points = test::random_disc(60, 8, 3);
  std::vector<Vector3> velocity;
  for (const Vector3& x : points) velocity.push_back({30 + 2 * x.x - 3 * x.y, -7 + 5 * x.x + 0.5 * x.y, 0});
  const Links links(points, 4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto gradient = velocity_gradient(points, velocity, links, i);
    ASSERT_TRUE(gradient);
    EXPECT_NEAR(gradient->xx, 2, 1e-10);
    EXPECT_NEAR(gradient->xy, -3, 1e-10);
    EXPECT_NEAR(gradient->yx, 5, 1e-10);
    EXPECT_NEAR(gradient->yy, 0.5, 1e-10);
    EXPECT_NEAR(gradient->curl(), 8, 1e-10);
  }
}

TEST(VelocityGradient, OfAFieldThatIsNotAffineIsThatOfTheNearestOne) {
  // The corners of a square, one of which moves: from all four, the grain itself among them, half along each side.
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<Vector3> velocity = {{}, {}, {}, {1, 0, 0}};
  const Links links(points, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto gradient = velocity_gradient(points, velocity, links, i);
    ASSERT_TRUE(gradient);
    EXPECT_NEAR(gradient->xx, 0.5, 1e-15);
    EXPECT_NEAR(gradient->xy, 0.5, 1e-15);
    EXPECT_NEAR(gradient->yx, 0, 1e-15);
  }
}

TEST(VelocityGradient, NeedsThreeGrainsOffOneLine) {
  const Points points = {{0, 0, 0}, {0.1, 0.3, 0}, {0.2, 0.6, 0}, {50, 0, 0}, {51, 0, 0}, {51, 1, 0}};
  const std::vector<Vector3> velocity(6);
  const Links links(points, 4);
  EXPECT_FALSE(velocity_gradient(points, velocity, links, 1));
  EXPECT_TRUE(velocity_gradient(points, velocity, links, 3));
  EXPECT_FALSE(velocity_gradient(points, velocity, Links(points, 1.1), 3)) << "one neighbour";
}

TEST(HeadMotion, OfAPairOfVortices) {
  // Two blocks beside the centre line; the flow is fastest there: v_x = 40 - 3 |y|, and outwards: v_y = 2 y.
  Points points = test::block({0, 4, 0}, 8, 6, 2);
  test::append(points, test::block({0, -14, 0}, 8, 6, 2));
  std::vector<Vector3> velocity;
  for (const Vector3& x : points) velocity.push_back({40 - 3 * std::abs(x.y), 2 * x.y, 0});
  const std::vector<double> radius(points.size(), 1.0);
  GrainSet head(points.size());
  std::iota(head.begin(), head.end(), 0u);
  const HeadSize size = head_size(points, radius, head, 1);
  ASSERT_DOUBLE_EQ(size.width, 30);
  ASSERT_DOUBLE_EQ(size.thickness, 16);
  const HeadMotion motion = head_motion(points, velocity, Links(points, 4), head, size, 20);
  EXPECT_NEAR(motion.curl_left, 3, 1e-10);
  EXPECT_NEAR(motion.curl_right, -3, 1e-10);
  // Central half: |y| <= 7.5, the columns at 4 and 6.
  EXPECT_NEAR(motion.rear_relative_velocity, 40 - 3 * 5 - 20, 1e-12);
  EXPECT_NEAR(motion.front_outward_velocity, 2 * 9, 1e-12);
}

TEST(HeadMotion, HasNoValueWithoutGrains) {
  const Points one = {{0, 0, 0}};
  const std::vector<double> radius = {1};
  const HeadMotion motion =
      head_motion(one, std::vector<Vector3>(1), Links(one, 4), {0}, head_size(one, radius, {0}, 1), 0);
  EXPECT_TRUE(std::isnan(motion.curl_left));
  EXPECT_TRUE(std::isnan(motion.rear_relative_velocity));
}

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

TEST(DisplacementSpread, DoesNotSeeACommonShift) {
  const Points before = {{0, 0, 0}, {5, 1, 0}, {2, 7, 0}};
  const Points after = {{10, 1, 0}, {16, 2, 0}, {11, 8, 0}};
  const DisplacementSpread spread = displacement_spread(before, after);
  EXPECT_DOUBLE_EQ(spread.mean, 10);
  EXPECT_DOUBLE_EQ(spread.along, 1);
  EXPECT_NEAR(spread.lateral, 0, 1e-15);
  EXPECT_THROW(displacement_spread(before, std::span(after).first(2)), std::invalid_argument);
  EXPECT_THROW(displacement_spread({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace talus
