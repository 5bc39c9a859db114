// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/random.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/neighbour_list.hpp"

namespace talus {
namespace {

std::vector<Vector3> random_points(std::size_t count, Vector3 box, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3> points(count);
  for (Vector3& p : points) p = {box.x * random.uniform(), box.y * random.uniform(), box.z * random.uniform()};
  return points;
}

TEST(NeighbourList, FindsExactlyThePairsThatAllPairsFind) {
  for (const Vector3 box : {Vector3{30, 30, 0}, Vector3{10, 10, 10}, Vector3{1000, 3, 0}}) {
    auto points = random_points(500, box, 7);
    points.push_back({1e5, -2e4, 3e3});  // one far away
    Random random(8);
    std::vector<double> radius(points.size());
    for (double& a : radius) a = random.uniform(0.5, 1.5);
    ThreadTeam team(2);
    NeighbourList list;
    list.build(team, points, radius, 0.3);
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t j = 0; j < points.size(); ++j)
        if (j != i && norm(points[i] - points[j]) <= radius[i] + radius[j] + 0.3) expected.push_back(j);
      const auto found = list.of(i);
      EXPECT_THAT(std::vector<std::uint32_t>(found.begin(), found.end()), testing::ElementsAreArray(expected));
      pairs += expected.size();
    }
    EXPECT_GT(pairs, 500u);
  }
}

TEST(NeighbourList, HoldsUntilTwoParticlesCouldHaveClosedTheSkin) {
  ThreadTeam team(1);
  std::vector<Vector3> points = {{0, 0, 0}, {3, 0, 0}};
  const std::vector<double> radius = {1, 1};
  NeighbourList list;
  EXPECT_FALSE(list.holds(team, points));
  list.build(team, points, radius, 0.5);
  EXPECT_TRUE(list.holds(team, points));
  points[1].x -= 0.498;  // each 0.249 from the mean
  EXPECT_TRUE(list.holds(team, points));
  for (Vector3& p : points) p.y += 100;  // together
  EXPECT_TRUE(list.holds(team, points));
  points[1].x -= 0.004;
  EXPECT_FALSE(list.holds(team, points));
  points[1].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(list.holds(team, points));
}

TEST(CellGrid, RefusesWhatItCannotHold) {
  const std::vector<Vector3> infinite = {{0, 0, 0}, {std::numeric_limits<double>::infinity(), 0, 0}};
  EXPECT_THROW(CellGrid(infinite, 1.0), std::invalid_argument);
  const std::vector<Vector3> wide = {{0, 0, 0}, {1e7, 0, 0}};
  EXPECT_THROW(CellGrid(wide, 1.0), std::invalid_argument);
  EXPECT_NO_THROW(CellGrid(wide, 10.0));
}

TEST(SpatialOrder, IsAPermutationThatKeepsNeighboursNear) {
  const auto points = random_points(4096, {64, 64, 0}, 3);
  const auto order = spatial_order(points, 1.0);
  EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), points.size());
  double sorted = 0, unsorted = 0;
  for (std::size_t n = 1; n < points.size(); ++n) {
    sorted += norm(points[order[n]] - points[order[n - 1]]);
    unsorted += norm(points[n] - points[n - 1]);
  }
  EXPECT_LT(sorted, 0.1 * unsorted);
}

}  // namespace
}  // namespace talus
