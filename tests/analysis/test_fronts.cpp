// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/fronts.hpp"

namespace talus {

namespace {

/// Records of X(t) = 2 + 3 t + 5 t² / 2 at the given step, to t = 4.
Curve accelerated(double step) {
  Curve front;
  for (int n = 0; n * step <= 4 + 1e-12; ++n) {
    const double t = n * step;
    front.time.push_back(t);
    front.value.push_back(2 + 3 * t + 2.5 * t * t);
  }
  return front;
}

TEST(FrontPosition, IsTheLargestX) {
  const std::vector<Vector3> grains = {{1, 9, 0.5}, {4, 0, 3}, {3, -2, 1.9}};
  EXPECT_EQ(front_position(grains), 4);
  EXPECT_EQ(front_position_on_slope(grains, 2), 3);
  EXPECT_EQ(front_position_on_slope(grains, 0.5), std::nullopt);
  EXPECT_EQ(front_position({}), std::nullopt);
}

TEST(FrontSpeed, OfAnAcceleratedFrontIsThatOfTheWindowsMiddle) {
  const Curve front = accelerated(0.125);
  for (const double t : {0.25, 1.0, 4.0}) EXPECT_NEAR(front_speed(front, t, 0.25), 3 + 5 * (t - 0.125), 1e-12);
}

TEST(FrontSpeed, DoesNotDependOnTheStep) {
  Curve uneven;
  for (double t = 0, step = 0.01; t < 4.2; t += step, step = 0.01 + 0.05 * std::abs(std::sin(40 * t))) {
    uneven.time.push_back(t);
    uneven.value.push_back(7 * t);
  }
  const Curve speed = front_speed_curve(uneven, 0.25, 4);
  ASSERT_EQ(speed.time.size(), 16u);
  for (std::size_t n = 0; n < 16; ++n) {
    EXPECT_DOUBLE_EQ(speed.time[n], 0.25 * static_cast<double>(n + 1));
    EXPECT_NEAR(speed.value[n], 7, 1e-12);
  }
  // Between records the front is linear: of an accelerated front the error is bounded by 5 step² / 8 at each end.
  for (const double t : {0.25, 0.77, 3.9})
    EXPECT_NEAR(front_speed(accelerated(0.01), t, 0.25), 3 + 5 * (t - 0.125), 2 * 5 * 1e-4 / 8 / 0.25);
}

TEST(FrontSpeed, StartsWhereTheRecordsStartAndEndsWithTheRun) {
  Curve front = accelerated(0.1);
  for (double& t : front.time) t += 10;
  const Curve speed = front_speed_curve(front, 0.3, 14);
  EXPECT_EQ(speed.time.size(), 13u);
  EXPECT_DOUBLE_EQ(speed.time.front(), 10.3);
  EXPECT_THROW(front_speed(front, 10.1, 0.3), std::invalid_argument);
  EXPECT_THROW(front_speed(front, 14.2, 0.3), std::invalid_argument);
  EXPECT_TRUE(front_speed_curve({}, 0.3, 1).time.empty());
}

TEST(Curve, ExtremesAndCrossing) {
  const Curve curve{{1, 2, 3, 4, 5}, {4, 9, 2, 9, -1}};
  const Extremes found = extremes(curve);
  EXPECT_EQ(found.min, -1);
  EXPECT_EQ(found.max, 9);
  EXPECT_EQ(found.max_time, 2);
  EXPECT_DOUBLE_EQ(first_time_at_or_below(curve, 3.75), 2.75);
  EXPECT_DOUBLE_EQ(first_time_at_or_below(curve, 4), 1);
  EXPECT_TRUE(std::isnan(first_time_at_or_below(curve, -2)));
  EXPECT_TRUE(std::isnan(extremes({{1, 2}, {3, NAN}}).max));
  EXPECT_THROW(extremes({}), std::invalid_argument);
}

TEST(Curve, APartLeavesItsFirstTimeOutAndKeepsItsLast) {
  const Curve curve{{0.1, 0.2, 0.1 + 0.2, 0.4}, {1, 2, 3, 4}};
  EXPECT_EQ(part(curve, 0.1, 0.3).value, (std::vector<double>{2, 3}));  // 0.1 + 0.2 is 0.30000000000000004
  EXPECT_EQ(part(curve, 0.3, 1).value, (std::vector<double>{4}));
  EXPECT_TRUE(part(curve, 1, 2).value.empty());
}

TEST(Curve, NearestPointIsTheEarlierOfTwo) {
  const std::vector<double> time = {0, 1, 2, 4};
  EXPECT_EQ(nearest_point(time, 1.5), 1u);
  EXPECT_EQ(nearest_point(time, 1.6), 2u);
  EXPECT_EQ(nearest_point(time, 99), 3u);
}

}  // namespace

}  // namespace talus
