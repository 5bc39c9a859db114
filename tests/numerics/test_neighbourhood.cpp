// SPDX-License-Identifier: Apache-2.0
#include "numerics/neighbourhood.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "base/random.hpp"
#include "surface/shapes.hpp"

namespace talus {
namespace {

using enum FaceKind;

struct Points {
  std::vector<Vector3> position;
  std::vector<double> radius;
};

Points random_points(const Box& box, std::size_t count, double least, double most) {
  Random random(11);
  Points points;
  for (std::size_t n = 0; n < count; ++n) {
    points.position.push_back({random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
                               random.uniform(box.low.z, box.high.z)});
    points.radius.push_back(random.uniform(least, most));
  }
  return points;
}

/// All places that a point stands for in an endless row of mirrors or periods, per axis, by their definition.
std::vector<double> copies(const Box& box, int axis, double x, double reach) {
  std::vector<double> found;
  const double low = box.low[axis], extent = box.extent(axis);
  for (int n = -20; n <= 20; ++n) {
    if (box.is_periodic(axis)) {
      found.push_back(x + n * extent);
    } else {
      found.push_back(x + 2 * n * extent);
      found.push_back(2 * low - x + 2 * n * extent);
    }
  }
  std::erase_if(found, [&](double c) { return c < low - reach || c > low + extent + reach; });
  return found;
}

TEST(Neighbourhood, FindsEveryCopyOfEveryNeighbourAlsoInThinBoxes) {
  for (const Box& box : {Box{{0, 0, 0}, {6, 1, 8}, {wall, wall, symmetry, wall, symmetry, symmetry}},
                         Box{{-1, 0, 0}, {5, 0.7, 8}, {wall, wall, periodic, periodic, wall, wall}},
                         Box{{0, 0, 0}, {1.1, 1.2, 1.3}, {wall, wall, periodic, periodic, wall, symmetry}}}) {
    const Points points = random_points(box, 60, 0.5, 0.8);
    const double skin = 0.2;
    ThreadTeam team(2);
    const Domain domain(box);
    Neighbourhood around(domain);
    around.build(team, points.position, points.radius, skin);
    std::size_t with_itself = 0;
    for (std::size_t i = 0; i < 60; ++i) {
      std::vector<double> expected, found;
      for (std::size_t j = 0; j < 60; ++j)
        for (const double x : copies(box, 0, points.position[j].x, 2))
          for (const double y : copies(box, 1, points.position[j].y, 2))
            for (const double z : copies(box, 2, points.position[j].z, 2)) {
              const Vector3 place{x, y, z};
              if (place == points.position[i]) continue;
              const double distance = norm(place - points.position[i]);
              if (distance <= points.radius[i] + points.radius[j] + skin) expected.push_back(distance);
            }
      for (const std::uint32_t j : around.of(i)) {
        if (j < 60) {
          found.push_back(norm(points.position[j] - points.position[i]));
        } else {
          const Ghost ghost = around.ghosts()[j - 60];
          found.push_back(norm(around.image(ghost).position(points.position[ghost.source]) - points.position[i]));
          with_itself += ghost.source == i;
        }
      }
      std::sort(expected.begin(), expected.end());
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found.size(), expected.size()) << i;
      for (std::size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], 1e-12);
      EXPECT_EQ(around.first_ghost_of(i),
                std::count_if(around.of(i).begin(), around.of(i).end(), [](std::uint32_t j) { return j < 60; }));
    }
    EXPECT_GT(with_itself, 60u);
  }
}

TEST(Neighbourhood, HoldsUntilMotionAndGrowthTogetherPassHalfTheSkin) {
  const Box box{{0, 0, 0}, {10, 10, 10}, {wall, wall, wall, wall, wall, open}};
  ThreadTeam team(1);
  const Domain domain(box);
  Neighbourhood around(domain);
  std::vector<Vector3> x = {{1, 1, 1}, {2, 1, 1}};
  std::vector<double> a = {1, 1};
  EXPECT_FALSE(around.holds(team, x, a));
  around.build(team, x, a, 0.5);
  EXPECT_TRUE(around.holds(team, x, a));
  for (Vector3& p : x) p.z += 0.24;  // also together: walls do not move along
  EXPECT_TRUE(around.holds(team, x, a));
  a[0] += 0.02;
  EXPECT_FALSE(around.holds(team, x, a));
  a[0] -= 0.2;
  EXPECT_TRUE(around.holds(team, x, a));
  x[1].z = NAN;
  EXPECT_FALSE(around.holds(team, x, a));
}

TEST(Neighbourhood, EachParticleHasAMarginOfItsOwn) {
  const Box box{{0, 0, 0}, {10, 10, 10}, {wall, wall, wall, wall, wall, open}};
  ThreadTeam team(1);
  const Domain domain(box);
  Neighbourhood around(domain);
  std::vector<Vector3> x = {{5, 5, 5}, {7.25, 5, 5}, {2.85, 5, 5}};
  const std::vector<double> a = {1, 1, 1}, margin = {0.1, 0.2, 0};
  around.build(team, x, a, margin);
  EXPECT_EQ(around.of(0).size(), 1u);
  EXPECT_EQ(around.of(0)[0], 1u);
  x[1].y += 0.19;
  EXPECT_TRUE(around.holds(team, x, a));
  x[0].y += 0.11;
  EXPECT_FALSE(around.holds(team, x, a));
}

/// A ball, which is convex from within and not from outside, and plates that cross it: whoever a line meets none of is
/// listed, whatever the quick tests say.
TEST(Neighbourhood, ListsWhoTheVesselDoesNotHide) {
  for (const int halvings : {1, 3}) {
    std::vector<Triangle> triangles = ball(halvings);
    for (const double z : {-0.4, 0.3})
      triangles.push_back({{Vector3{-2, -1.5, z}, {2, -1.5, z}, {0, 1.5, z + 0.2}}, 0});
    const Surface vessel(triangles, 1);
    const Box box{{-1.4, -1.4, -1.4}, {1.4, 1.4, 1.4}, {open, open, open, open, open, open}};
    Points points = random_points(box, 1500, 0.08, 0.12);
    std::sort(points.position.begin(), points.position.end(),
              [](const Vector3& a, const Vector3& b) { return std::floor(a.x * 5) + a.z < std::floor(b.x * 5) + b.z; });
    ThreadTeam team(2);
    const Domain domain(box);
    Neighbourhood around(domain, vessel);
    around.build(team, points.position, points.radius, 0.02);
    std::size_t listed = 0, hidden = 0;
    double apart = 0;
    for (std::size_t i = 0; i < points.position.size(); ++i) {
      const Vector3& x = points.position[i];
      const auto foot = vessel.nearest(x, around.reach());
      const double distance = foot ? foot->distance : around.reach();
      EXPECT_GE(around.distance_from_vessel(i), 0);
      EXPECT_LE(std::min(around.distance_from_vessel(i), around.reach()), distance * (1 + 1e-12));
      apart += distance - std::min(around.distance_from_vessel(i), around.reach());
      std::vector<std::uint32_t> expected;
      for (std::uint32_t j = 0; j < points.position.size(); ++j) {
        if (j == i || !(norm(points.position[j] - x) <= points.radius[i] + points.radius[j] + 0.02)) continue;
        if (vessel.blocks(x, points.position[j]))
          ++hidden;
        else
          expected.push_back(j);
      }
      listed += expected.size();
      EXPECT_THAT(around.of(i), testing::ElementsAreArray(expected)) << i;
    }
    EXPECT_GT(listed, 3000u);
    EXPECT_GT(hidden, 250u);
    EXPECT_LT(apart / static_cast<double>(points.position.size()), 0.1 * around.reach());
  }
}

/// Who is not in doubt is seen wherever both have moved while the lists hold.
TEST(Neighbourhood, SeesAllThatAreNotInDoubt) {
  const Box box{{0, 0, 0}, {20, 10, 20}, {wall, wall, wall, wall, wall, open}};
  const Domain domain(box, {Wall("plate", {0, 0, 10}, {20, 0, 10}, {{6, 14}})});
  Random random(4);
  std::vector<Vector3> x;
  for (int n = 0; n < 3000; ++n) x.push_back({random.uniform(0, 20), random.uniform(0, 10), random.uniform(7, 13)});
  ThreadTeam team(1);
  Neighbourhood around(domain);
  constexpr double margin = 0.1;
  around.build(team, x, std::vector<double>(x.size(), 0.7), 2 * margin);
  std::vector<Vector3> now = x;
  for (Vector3& place : now)
    place = domain.fold(
        place + margin * Vector3{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)});
  std::size_t sure = 0, doubts = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto neighbours = around.of(i);
    const auto in_doubt = around.in_doubt(i);
    ASSERT_EQ(in_doubt.size(), around.sight_may_change(i) ? neighbours.size() : 0);
    for (std::size_t n = 0; n < in_doubt.size(); ++n) {
      const std::size_t j = neighbours[n];
      if (in_doubt[n]) {
        ++doubts;
        continue;
      }
      const Image image = j < x.size() ? Image{} : around.image(around.ghosts()[j - x.size()]);
      const std::size_t source = j < x.size() ? j : around.ghosts()[j - x.size()].source;
      EXPECT_TRUE(domain.is_visible(now[i], image.position(now[source]), image)) << i << ' ' << j;
      ++sure;
    }
  }
  EXPECT_GT(sure, 1000u);
  EXPECT_GT(doubts, 1000u);
}

TEST(Neighbourhood, RefusesAReachThatPassesFromPlateToFloor) {
  const Box box{{0, 0, 0}, {10, 10, 10}, {wall, wall, wall, wall, wall, open}};
  ThreadTeam team(1);
  const Domain domain(box, {Wall("plate", {0, 0, 1.5}, {10, 0, 1.5})});
  Neighbourhood around(domain);
  const std::vector<Vector3> x = {{5, 5, 5}};
  EXPECT_THROW(around.build(team, x, std::vector<double>{0.7}, 0.2), std::invalid_argument);
  EXPECT_NO_THROW(around.build(team, x, std::vector<double>{0.6}, 0.2));
  EXPECT_FALSE(around.sight_may_change(0));
}

}  // namespace
}  // namespace talus
