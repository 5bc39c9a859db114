// SPDX-License-Identifier: Apache-2.0
#include "ranks/ranks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ranks/halo.hpp"

namespace talus {
namespace {

using ::testing::ElementsAre;

TEST(OneProcess, HasItsOwnVotes) {
  Votes votes{.least = {2}, .largest = {-3}, .sum = {5}};
  one_process().join(votes);
  EXPECT_THAT(votes.least, ElementsAre(2));
  EXPECT_THAT(votes.largest, ElementsAre(-3));
  EXPECT_THAT(votes.sum, ElementsAre(5));
  EXPECT_FALSE(all_of(one_process(), false));
  EXPECT_TRUE(all_of(one_process(), true));
}

TEST(OneProcess, SendsToItself) {
  const std::vector<std::size_t> counts{3};
  const auto plan = one_process().plan(counts);
  EXPECT_EQ(plan->received(), 3u);
  EXPECT_THAT(plan->exchange(std::vector<double>{4, 5, 6}), ElementsAre(4, 5, 6));
  EXPECT_THAT(one_process().gather_values(std::vector<int>{1, 2}), ElementsAre(1, 2));
}

TEST(OneProcess, OwnsAllOfSpace) {
  const auto partition = one_process().partition();
  partition->cut(std::vector<Vector3>{{0, 0, 0}}, std::vector<double>{1});
  EXPECT_EQ(partition->rank_of({1e9, 0, -1e9}), 0);
  std::vector<int> ranks;
  partition->ranks_of({0, 0, 0}, {1, 1, 1}, ranks);
  EXPECT_THAT(ranks, ElementsAre(0));
}

TEST(Halo, HasNothingAtFirst) {
  Halo halo;
  std::vector<double> values{1, 2};
  halo.refresh(std::vector{Halo::column(std::span(values))});
  EXPECT_THAT(values, ElementsAre(1, 2));
  EXPECT_EQ(halo.received(), 0u);
}

TEST(Halo, GivesCopiesTheValuesOfTheirOwners) {
  const std::vector<std::size_t> counts{2};
  Halo halo(one_process().plan(counts), {0, 3}, {2, 1});  // 0 to 2, 3 to 1
  std::vector<double> values{10, 0, 0, 13};
  std::vector<Vector3> places{{1, 2, 3}, {}, {}, {4, 5, 6}};
  halo.refresh(std::vector{Halo::column(std::span(values)), Halo::column(std::span(places))});
  EXPECT_THAT(values, ElementsAre(10, 13, 10, 13));
  EXPECT_EQ(places[1].y, 5);
  EXPECT_EQ(places[2].z, 3);
}

}  // namespace
}  // namespace talus
