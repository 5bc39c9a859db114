// SPDX-License-Identifier: Apache-2.0
#include "analysis/frontal_angle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace talus {
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
