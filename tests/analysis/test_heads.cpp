// SPDX-License-Identifier: Apache-2.0
#include "analysis/heads.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "analysis/lattice.hpp"

namespace talus {
namespace {

using test::Points;
using testing::ElementsAre;
using testing::ElementsAreArray;

GrainSet range(std::size_t first, std::size_t count) {
  GrainSet set(count);
  std::iota(set.begin(), set.end(), static_cast<std::uint32_t>(first));
  return set;
}

TEST(NeighbourNumbers, OfAChain) {
  const Points chain = {{0, 0, 0}, {3.9, 0, 0}, {7.8, 0, 0}, {11.7, 0, 0}, {15.6, 0, 0}};
  const Links links(chain, 4);
  const NeighbourNumbers numbers = neighbour_numbers(links);
  EXPECT_THAT(numbers.direct, ElementsAre(1, 2, 2, 2, 1));
  EXPECT_THAT(numbers.indirect, ElementsAre(2, 3, 4, 3, 2));
}

TEST(NeighbourNumbers, AGrainAtTheReachIsNoNeighbour) {
  const NeighbourNumbers numbers = neighbour_numbers(Links(Points{{0, 0, 0}, {4, 0, 0}}, 4));
  EXPECT_THAT(numbers.direct, ElementsAre(0, 0));
}

TEST(NeighbourNumbers, OfASquareLattice) {
  const Points lattice = test::block({0, 0, 0}, 9, 9, 2);
  const NeighbourNumbers numbers = neighbour_numbers(Links(lattice, 4));
  EXPECT_EQ(numbers.direct[40], 8u);  // the middle: the 8 around it; those at 4 are not closer than 4
  EXPECT_EQ(numbers.indirect[40], 64u);
  EXPECT_EQ(numbers.direct[0], 3u);  // a corner
  EXPECT_EQ(numbers.indirect[0], 5u + 5u + 8u);
}

TEST(Links, ConnectedSetsOfTheGrainsThatTakePart) {
  const Points points = {{0, 0, 0}, {3, 0, 0}, {6, 0, 0}, {20, 0, 0}, {22, 0, 0}, {9, 0, 0}};
  const Links links(points, 4);
  EXPECT_THAT(links.connected_sets(std::vector<bool>(6, true)), ElementsAre(GrainSet{0, 1, 2, 5}, GrainSet{3, 4}));
  EXPECT_THAT(links.connected_sets({true, false, true, true, false, true}),
              ElementsAre(GrainSet{0}, GrainSet{2, 5}, GrainSet{3}));
  EXPECT_THAT(max_set(links.connected_sets({true, true, false, true, true, false}), points), ElementsAre(3, 4))
      << "of equal sets the one farther down";
}

TEST(Heads, TwoBowsAndACrumb) {
  Points points = test::bow(100, 21);
  test::append(points, test::bow(0, 31));
  test::append(points, test::block({0, -100, 0}, 1, 19, 2));
  const std::vector<GrainSet> heads = find_heads(points, 1);
  ASSERT_EQ(heads.size(), 2u);
  EXPECT_THAT(heads[0], ElementsAreArray(range(test::grains_of_bow(21), test::grains_of_bow(31))));
  EXPECT_THAT(heads[1], ElementsAreArray(range(0, test::grains_of_bow(21))));

  const std::vector<double> radius(points.size(), 1.0);
  const HeadSize large = head_size(points, radius, heads[0], 1);
  EXPECT_DOUBLE_EQ(large.width, 62);
  EXPECT_DOUBLE_EQ(large.thickness, 8);
  EXPECT_DOUBLE_EQ(large.centre, 0);
  EXPECT_DOUBLE_EQ(large.foremost, 1);
  EXPECT_DOUBLE_EQ(large.inner, -7);
  EXPECT_DOUBLE_EQ(large.aspect_ratio(), 7.75);
  const HeadSize small = head_size(points, radius, heads[1], 1);
  EXPECT_DOUBLE_EQ(small.width, 42);
  EXPECT_DOUBLE_EQ(small.thickness, 8);
  EXPECT_DOUBLE_EQ(small.centre, 100);
}

TEST(Heads, TheLeastNumberOfGrains) {
  const Points five = test::block({0, 0, 0}, 1, 5, 2);
  EXPECT_EQ(find_heads(five, 1).size(), 1u);
  EXPECT_TRUE(find_heads(Points(five.begin(), five.end() - 1), 1).empty());
}

TEST(Heads, AThinBridgeDoesNotMergeTwo) {
  Points points = test::block({0, 0, 0}, 10, 10, 2);
  test::append(points, test::block({0, 60, 0}, 10, 10, 2));
  for (double y = 21; y < 59; y += 3) points.push_back({9, y, 0});
  ASSERT_EQ(Links(points, 4).connected_sets(std::vector<bool>(points.size(), true)).size(), 1u);
  EXPECT_EQ(find_heads(points, 1).size(), 2u);
}

TEST(Heads, AWeakHeadTakesItsOwnLargestNumberForItsRim) {
  // Inside, a lattice of spacing 1 has n = 44 and n' = 44², one of spacing 1.3 n = 28 and n' = 28².
  Points points = test::block({0, 0, 0}, 20, 20, 1);
  test::append(points, test::block({0, 100, 0}, 16, 16, 1.3));
  const NeighbourNumbers numbers = neighbour_numbers(Links(points, 4));
  ASSERT_EQ(numbers.indirect[10 * 20 + 10], 44u * 44u);
  ASSERT_EQ(numbers.indirect[400 + 8 * 16 + 8], 28u * 28u);
  GrainSet core, with_rim;
  for (std::uint32_t i = 400; i < points.size(); ++i) {
    if (numbers.indirect[i] > 484) core.push_back(i);      // 44² / 4
    if (numbers.indirect[i] > 196) with_rim.push_back(i);  // 28² / 4
  }
  ASSERT_GT(core.size(), 20u);
  ASSERT_GT(with_rim.size(), core.size());
  const auto heads = find_heads(points, 1);
  ASSERT_EQ(heads.size(), 2u);
  EXPECT_THAT(heads[1], ElementsAreArray(with_rim));
}

TEST(Heads, APartFarWeakerThanTheStrongestHasNone) {
  // A lattice of spacing 1 has n' = 44² inside; of a block of 9 grains, 2 apart, the middle has n' = 8 + 4 * 5 + 4 * 3.
  Points points = test::block({0, 0, 0}, 20, 20, 1);
  test::append(points, test::block({0, 100, 0}, 3, 3, 2));
  EXPECT_EQ(find_heads(points, 1).size(), 1u);
  EXPECT_EQ(find_heads(Points(points.begin() + 400, points.end()), 1).size(), 1u) << "alone it is one";
}

TEST(Heads, ATailIsNoPartOfTheHead) {
  // A block with a tail of two rows: in the tail n' = 25; of the last two n' = 3 + 5 + 5 = 13 is below 64 / 4.
  Points points = test::block({0, 0, 0}, 10, 10, 2);
  test::append(points, test::block({-40, 8, 0}, 20, 2, 2));
  const auto heads = find_heads(points, 1);
  ASSERT_EQ(heads.size(), 1u);
  EXPECT_EQ(heads[0].size(), 138u);
}

TEST(Heads, TheOrderOfTheGrainsAndTheSideDoNotMatter) {
  const Points points = test::random_disc(600, 60, 5);
  std::vector<double> radius(points.size());
  Random random(6);
  for (double& a : radius) a = random.uniform(0.95, 1.05);
  const auto heads = find_heads(points, 1);
  ASSERT_GT(heads.size(), 2u) << "the case is to have several heads";

  const std::size_t count = points.size();
  Points changed(count);
  std::vector<double> changed_radius(count);
  auto place = [&](std::size_t i) { return (i * 7 + 3) % count; };  // 7 and 600 have no common divisor
  for (std::size_t i = 0; i < count; ++i) {
    changed[place(i)] = {points[i].x, -points[i].y, 0};
    changed_radius[place(i)] = radius[i];
  }
  const auto changed_heads = find_heads(changed, 1);
  ASSERT_EQ(changed_heads.size(), heads.size());
  for (std::size_t h = 0; h < heads.size(); ++h) {
    GrainSet expected;
    for (const std::uint32_t i : heads[h]) expected.push_back(static_cast<std::uint32_t>(place(i)));
    std::sort(expected.begin(), expected.end());
    EXPECT_THAT(changed_heads[h], ElementsAreArray(expected));
    const HeadSize a = head_size(points, radius, heads[h], 1), b = head_size(changed, changed_radius, expected, 1);
    EXPECT_DOUBLE_EQ(a.width, b.width);
    EXPECT_DOUBLE_EQ(a.thickness, b.thickness);
    EXPECT_NEAR(a.centre, -b.centre, 1e-12);
  }
}

TEST(HeadSize, CountsTheGrainsOwnRadii) {
  const Points points = {{0, -5, 0}, {0, 5, 0}, {2, 0, 0}, {-1, 1, 0}};
  const std::vector<double> radius = {0.5, 2, 1, 0.25};
  const HeadSize size = head_size(points, radius, {0, 1, 2, 3}, 1);
  EXPECT_DOUBLE_EQ(size.width, 7 + 5.5);
  EXPECT_DOUBLE_EQ(size.centre, 0.75);
  EXPECT_DOUBLE_EQ(size.foremost, 3);
  EXPECT_DOUBLE_EQ(size.inner, -1.25);  // both central grains see the rearmost edge among the two of them
}

TEST(HeadSize, AGapOutsideTheCentralHalfDoesNotCount) {
  Points points = test::block({-6, -30, 0}, 4, 31, 2);
  std::vector<double> radius(points.size(), 1.0);
  GrainSet head;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (!(points[i].y > 17 && points[i].y < 27 && points[i].x < 0)) head.push_back(i);
  EXPECT_DOUBLE_EQ(head_size(points, radius, head, 1).thickness, 8);
}

TEST(Heads, OfNoGrainsAndOfOne) {
  EXPECT_TRUE(find_heads({}, 1).empty());
  const Points one = {{3, 2, 0}};
  EXPECT_TRUE(find_heads(one, 1).empty()) << "a grain without neighbours is above a quarter of none";
  const std::vector<double> radius = {0.5};
  const HeadSize size = head_size(one, radius, {0}, 1);
  EXPECT_DOUBLE_EQ(size.width, 1);
  EXPECT_DOUBLE_EQ(size.thickness, 1);
  EXPECT_TRUE(max_set({}, one).empty());
}

}  // namespace
}  // namespace talus
