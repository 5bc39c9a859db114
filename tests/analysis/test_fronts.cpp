// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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

namespace {

using std::numbers::pi;
using Points = std::vector<Vector3>;
using testing::ElementsAre;

constexpr double degree = pi / 180;

/// Columns of unit grains, 2 apart, standing on the slope; each column backwards is lower by a little, so that the
/// front column's top is the top. Each layer is moved by `shift`. Grain k of the front column has index k.
Points wall(int layers, int columns, double shift) {
  Points points;
  for (int column = 0; column < columns; ++column)
    for (int layer = 0; layer < layers; ++layer)
      points.push_back({-2.0 * column + shift * layer, 0, 1 + 2.0 * layer - 0.01 * column});
  return points;
}

/// An equilateral triangle of unit grains, 2 apart, its base on the slope.
Points triangle(int side) {
  Points points;
  for (int layer = 0; layer < side; ++layer)
    for (int n = 0; n < side - layer; ++n) points.push_back({-2.0 * n - layer, 0, 1 + layer * std::sqrt(3.0)});
  return points;
}

double angle(const Points& points) {
  return angle_of_line(points, surface_walk(points, 1)).value() / degree;
}

TEST(FrontalAngle, OfATriangularLattice) {
  const Points points = triangle(12);
  const GrainSet walk = surface_walk(points, 1);
  ASSERT_EQ(walk.size(), 12u);
  EXPECT_EQ(walk.front(), 0u);
  EXPECT_NEAR(angle(points), 60, 1e-10);
}

TEST(FrontalAngle, OfUprightOverhangingAndLeaningWalls) {
  EXPECT_NEAR(angle(wall(10, 8, 0)), 90, 1e-10);
  EXPECT_NEAR(angle(wall(10, 8, -0.5)), std::atan2(2, 0.5) / degree, 1e-10);
  // The foremost grain of an overhanging wall is its top: the walk has nowhere to go.
  EXPECT_EQ(surface_walk(wall(10, 8, 0.5), 1).size(), 1u);
}

TEST(FrontalAngle, GrainsBelowTheForemostTakeNoPart) {
  Points points = wall(10, 8, -0.5);
  for (const Vector3& x : wall(4, 8, 0.5)) points.push_back({x.x - 2, 0, x.z - 8});
  const GrainSet walk = surface_walk(points, 1);
  EXPECT_EQ(walk.size(), 10u);
  EXPECT_EQ(*std::max_element(walk.begin(), walk.end()), 9u);
}

TEST(FrontalAngle, TheWalkEndsAtAGrainThatSticksOut) {
  Points points = triangle(12);
  // On the face, touching the third and fourth grain of the surface, a little higher than the place in the lattice,
  // where the way would lead on.
  const auto bump = static_cast<std::uint32_t>(points.size());
  points.push_back({points[12 + 11].x + 1, 0, 1 + 3 * std::sqrt(3.0) + 0.02});
  const GrainSet walk = surface_walk(points, 1);
  EXPECT_EQ(walk.back(), bump);
  EXPECT_LT(walk.size(), 12u);
}

TEST(FrontalAngle, TakesTheLargestCluster) {
  Points points = triangle(12);
  points.push_back({50, 0, 1});  // a grain far ahead
  EXPECT_NEAR(angle(points), 60, 1e-10);
}

TEST(FrontalAngle, AGapWiderThanAStepEndsTheWalk) {
  Points points = wall(5, 4, 0);
  for (Vector3 x : wall(5, 4, 0)) points.push_back({x.x, 0, x.z + 11.5});  // linked at 3.5, but no step of 3
  EXPECT_EQ(surface_walk(points, 1).size(), 5u);
}

TEST(AngleOfLine, TurnsWithTheGrains) {
  // Scattered about a line through the origin; the least squared distance turns with them, an ordinary fit would not.
  const Points flat = {{-3, 0, 0.4}, {-1, 0, -0.3}, {0.5, 0, 0.2}, {2, 0, -0.1}, {4, 0, 0.1}};
  const double own = angle_of_line(flat, {0, 1, 2, 3, 4}).value();
  for (int turn = 5; turn < 175; turn += 10) {
    Points turned;
    for (const Vector3& x : flat)  // from -x towards +z, as the angle counts
      turned.push_back({x.x * std::cos(turn * degree) + x.z * std::sin(turn * degree), 0,
                        -x.x * std::sin(turn * degree) + x.z * std::cos(turn * degree)});
    EXPECT_NEAR(std::fmod(angle_of_line(turned, {0, 1, 2, 3, 4}).value() - own - turn * degree + 3 * pi, pi), 0, 1e-12)
        << turn;
  }
}

TEST(AngleOfLine, MirroredItIsTheSupplement) {
  const Points line = {{0, 0, 0}, {-1, 0, 2}, {-2, 0, 4.5}};
  const Points mirrored = {{0, 0, 0}, {1, 0, 2}, {2, 0, 4.5}};
  EXPECT_NEAR(angle_of_line(line, {0, 1, 2}).value() + angle_of_line(mirrored, {0, 1, 2}).value(), pi, 1e-14);
  EXPECT_LT(angle_of_line(line, {0, 1, 2}).value(), pi / 2) << "it leans back";
}

TEST(AngleOfLine, NeedsThreeGrainsAndADirection) {
  EXPECT_FALSE(angle_of_line(Points{{0, 0, 0}, {1, 0, 1}}, {0, 1}));
  EXPECT_FALSE(angle_of_line(Points{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {0, 1, 2, 3}));
  EXPECT_TRUE(surface_walk({}, 1).empty());
  EXPECT_THAT(surface_walk(Points{{1, 2, 3}}, 1), ElementsAre(0));
}

}  // namespace

}  // namespace talus
