// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/instruction_set.hpp"
#include "base/random.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/near_points/kernel.hpp"
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
    for (std::size_t n = 0; n < points.size(); n += 100) radius[n] = 5;  // a few reach over several cells
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

TEST(NeighbourList, FindsThePairsOfParticlesAndGhostsThatAreKept) {
  const auto points = random_points(3000, {12, 12, 12}, 9);
  const std::vector<double> radius(points.size(), 0.6);
  const std::size_t listed = 1000;
  const auto is_kept = [](std::size_t i, std::uint32_t j) { return j < 2000 || (i + j) % 3 == 0; };
  ThreadTeam team(2);
  NeighbourList list;
  for (const double skin : {0.3, 0.1})  // the second time into used memory
    list.build(team, points, radius, skin, listed, [&](std::size_t i, std::span<std::uint32_t> near) {
      return static_cast<std::size_t>(
          std::remove_if(near.begin(), near.end(), [&](std::uint32_t j) { return !is_kept(i, j); }) - near.begin());
    });
  for (std::size_t i = 0; i < listed; ++i) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t j = 0; j < points.size(); ++j)
      if (j != i && norm(points[i] - points[j]) <= 1.3 && is_kept(i, j)) expected.push_back(j);
    const auto found = list.of(i);
    EXPECT_THAT(std::vector<std::uint32_t>(found.begin(), found.end()), testing::ElementsAreArray(expected)) << i;
    for (std::size_t n = found.size(); n % NeighbourList::padded_to != 0; ++n)
      EXPECT_EQ(found.data()[n], points.size());
  }
}

TEST(NeighbourList, OfMorePointsThanAreFoundAtOnceIsTheSame) {
  constexpr int side = 33;  // of a lattice whose planes have numbers far apart: cells have points of several turns
  constexpr std::size_t count = std::size_t{side} * side * side;
  static_assert(count > NeighbourList::found_at_once);
  const auto number = [](int x, int y, int z) {
    return static_cast<std::uint32_t>((7 * x % side * side + y) * side + z);
  };
  std::vector<Vector3> points(count);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) points[number(x, y, z)] = Vector3{1.0 * x, 1.0 * y, 1.0 * z};
  ThreadTeam team(2);
  NeighbourList list;
  const std::size_t listed = count - 3 * side;
  for (const double radius : {0.45, 0.55})  // the second time into used memory, which is too small
    list.build(team, points, std::vector<double>(count, radius), 0, listed, nullptr);
  std::size_t wrong = 0;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        const std::uint32_t i = number(x, y, z);
        if (i >= listed) continue;
        std::vector<std::uint32_t> expected;
        for (const int step : {-1, 1}) {
          if (x + step >= 0 && x + step < side) expected.push_back(number(x + step, y, z));
          if (y + step >= 0 && y + step < side) expected.push_back(number(x, y + step, z));
          if (z + step >= 0 && z + step < side) expected.push_back(number(x, y, z + step));
        }
        std::sort(expected.begin(), expected.end());
        const auto found = list.of(i);
        wrong += !std::equal(found.begin(), found.end(), expected.begin(), expected.end());
      }
  EXPECT_EQ(wrong, 0u);
}

TEST(NearPoints, AreTheSameForAllInstructionSets) {
  constexpr std::size_t size = PointBlock::size, count = 30;
  Random random(5);
  std::vector<PointBlock> blocks(count);
  for (std::size_t b = 0; b < count; ++b)
    for (std::size_t k = 0; k < size; ++k) {
      PointBlock& block = blocks[b];
      const double low = 0.2 * static_cast<double>(b);  // so that some blocks are out of reach
      block.x[k] = b + 1 == count && k > 2 ? std::numeric_limits<double>::infinity() : low + random.uniform(0, 2);
      block.y[k] = random.uniform(0, 4), block.z[k] = random.uniform(0, 4);
      block.radius[k] = random.uniform(0.5, 0.9);
      block.number[k] = static_cast<std::uint32_t>(3 * (size * b + k));
    }
  constexpr std::size_t groups = (count + BlockBoxes::size - 1) / BlockBoxes::size;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<BlockBoxes> boxes(groups);
  for (std::size_t b = 0; b < groups * BlockBoxes::size; ++b) {
    BlockBoxes& box = boxes[b / BlockBoxes::size];
    const std::size_t lane = b % BlockBoxes::size;
    box.block[lane] = static_cast<std::uint32_t>(b), box.radius[lane] = 0.9;
    for (std::size_t axis = 0; axis < 3; ++axis) box.low[axis][lane] = box.high[axis][lane] = infinity;
    if (b >= count) continue;
    const double* const columns[3] = {blocks[b].x, blocks[b].y, blocks[b].z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* const column = columns[axis];
      box.low[axis][lane] = *std::min_element(column, column + size);
      box.high[axis][lane] = *std::max_element(column, column + size);
    }
  }
  for (const std::size_t self : {std::size_t{0}, std::size_t{77}, size * (count - 1) + 2}) {
    const auto picked = [&](PickNear* pick) {
      std::vector<std::uint32_t> near(size * BlockBoxes::size * groups);
      near.resize(pick(blocks.data(), boxes.data(), groups, self, 0.2, near.data()));
      return near;
    };
    const std::vector<std::uint32_t> near = picked(pick_near_portable);
    EXPECT_GT(near.size(), 10u);
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    EXPECT_THAT(near, testing::Not(testing::Contains(3 * self)));
    EXPECT_LT(near.back(), 3 * (size * (count - 1) + 3));
    std::vector<std::uint32_t> expected;
    const auto point = [&](std::size_t n) {
      const PointBlock& block = blocks[n / size];
      return Vector3{block.x[n % size], block.y[n % size], block.z[n % size]};
    };
    const auto radius = [&](std::size_t n) { return blocks[n / size].radius[n % size]; };
    for (std::size_t n = 0; n < size * count; ++n)
      if (n != self && norm(point(n) - point(self)) <= radius(n) + radius(self) + 0.2)
        expected.push_back(static_cast<std::uint32_t>(3 * n));
    EXPECT_EQ(near, expected);
#if defined(__x86_64__)
    if (is_available(InstructionSet::avx2)) {
      EXPECT_EQ(picked(pick_near_avx2), near);
    }
    if (is_available(InstructionSet::avx512)) {
      EXPECT_EQ(picked(pick_near_avx512), near);
    }
#endif
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

TEST(CellGrid, SortsPointsByCellAndThenByNumber) {
  const auto points = random_points(2000, {300, 2, 3}, 4);  // more cells along x than a digit of the sort holds
  const CellGrid grid(points, 1.0);
  std::set<std::uint32_t> seen;
  double previous = 0;
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    const auto inside = grid.points_of(cell);
    ASSERT_FALSE(inside.empty());
    EXPECT_TRUE(std::is_sorted(inside.begin(), inside.end()));
    seen.insert(inside.begin(), inside.end());
    for (const std::uint32_t j : inside) EXPECT_LT(std::abs(points[j].x - points[inside.front()].x), 1.0);
    previous = points[inside.front()].x;
  }
  EXPECT_GT(previous, 290);
  EXPECT_EQ(seen.size(), points.size());
}

TEST(CellGrid, RowsBetweenTwoCornersHoldAllThatIsThere) {
  const auto points = random_points(3000, {9, 7, 5}, 8);
  const CellGrid grid(points, 0.8);
  for (const auto& [low, high] : {std::pair<Vector3, Vector3>{{2, 1, 1}, {4.5, 2, 3}}, {{-3, -3, 2}, {20, 1, 9}}}) {
    std::vector<std::uint32_t> found;
    grid.for_each_row_between(low, high, [&](std::span<const std::uint32_t> row) {
      EXPECT_TRUE(row.data() >= grid.order().data() && row.data() + row.size() <= grid.order().data() + points.size());
      found.insert(found.end(), row.begin(), row.end());
    });
    EXPECT_LT(found.size(), points.size() / 2);
    const std::set<std::uint32_t> once(found.begin(), found.end());
    EXPECT_EQ(once.size(), found.size());
    for (std::uint32_t n = 0; n < points.size(); ++n) {
      const Vector3& x = points[n];
      if (x.x < low.x || x.y < low.y || x.z < low.z || x.x > high.x || x.y > high.y || x.z > high.z) continue;
      EXPECT_TRUE(once.contains(n)) << n;
    }
  }
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
