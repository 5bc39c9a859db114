// SPDX-License-Identifier: Apache-2.0
/// Run by mpirun on several processes: every test is a call together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "base/random.hpp"
#include "ranks/halo.hpp"
#include "ranks/petsc/processes.hpp"
#include "ranks/slabs.hpp"

namespace talus {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

TEST(Processes, JoinVotes) {
  const int rank = processes().rank(), size = processes().size();
  Votes votes{.least = {10.0 - rank, 1.0}, .largest = {1.0 * rank}, .sum = {static_cast<std::uint64_t>(rank + 1), 7}};
  processes().join(votes);
  EXPECT_THAT(votes.least, ElementsAre(11.0 - size, 1.0));
  EXPECT_THAT(votes.largest, ElementsAre(size - 1.0));
  EXPECT_THAT(votes.sum, ElementsAre(size * (size + 1) / 2, 7 * size));
  EXPECT_FALSE(all_of(processes(), rank != size - 1));
}

TEST(Processes, SumInFixedPointAsOneProcessDoes) {
  const auto size = static_cast<std::size_t>(processes().size());
  const auto rank = static_cast<std::size_t>(processes().rank());
  const FixedPoint point(1);
  Random random(4);
  FixedVector all, own;
  for (std::size_t n = 0; n < 1000; ++n) {
    const Vector3 term{random.uniform(-1e6, 1e6), random.uniform(-1, 1), random.uniform(-1e-6, 1e-6)};
    all.add(point, term);
    if (n % size == rank) own.add(point, term);
  }
  sum_up(processes(), std::span(&own, 1));
  EXPECT_EQ(own.value(point).x, all.value(point).x);
  EXPECT_EQ(own.value(point).y, all.value(point).y);
  EXPECT_EQ(own.value(point).z, all.value(point).z);
}

TEST(Processes, AddUpInPlace) {
  const int size = processes().size();
  std::vector<double> sums{0x1p-50 * (processes().rank() + 1), -0.5};
  processes().add_up(sums);
  EXPECT_THAT(sums, ElementsAre(0x1p-51 * size * (size + 1), -0.5 * size));
}

TEST(Processes, GatherInTheirOrder) {
  std::vector<int> own(static_cast<std::size_t>(processes().rank()), processes().rank()), expected;
  for (int r = 0; r < processes().size(); ++r) expected.insert(expected.end(), static_cast<std::size_t>(r), r);
  EXPECT_EQ(processes().gather_values(own), expected);
  const std::string of_one(static_cast<std::size_t>(processes().rank()), 'x');
  const std::string all = processes().gather(of_one);
  EXPECT_EQ(processes().gather_at_first(of_one), processes().is_first() ? all : std::string());
  EXPECT_EQ(processes().value_from_first(5 + processes().rank()), 5);
}

/// From process s to process r go s + 2 r + 1 items, but none from the last to the first.
TEST(Plan, DeliversInTheOrderOfTheSenders) {
  struct Item {
    std::int64_t from, to, number;
  };
  const int size = processes().size(), rank = processes().rank();
  const auto count = [&](int s, int r) { return s == size - 1 && r == 0 ? 0 : s + 2 * r + 1; };
  std::vector<std::size_t> counts;
  std::vector<Item> items;
  for (int r = 0; r < size; ++r) {
    counts.push_back(static_cast<std::size_t>(count(rank, r)));
    for (int n = 0; n < count(rank, r); ++n) items.push_back({rank, r, n});
  }
  const auto plan = processes().plan(counts);
  for (int again = 0; again < 3; ++again) {
    const std::vector<Item> got = plan->exchange(items);
    std::size_t next = 0;
    for (int s = 0; s < size; ++s)
      for (int n = 0; n < count(s, rank); ++n, ++next) {
        ASSERT_LT(next, got.size());
        EXPECT_EQ(got[next].from, s);
        EXPECT_EQ(got[next].to, rank);
        EXPECT_EQ(got[next].number, n);
      }
    EXPECT_EQ(next, got.size());
  }
}

TEST(Halo, BringsTheValuesOfOtherProcesses) {
  const auto size = static_cast<std::size_t>(processes().size());
  const double rank = processes().rank();
  // Each process has a value of its own, in front, and copies of all, its own too, behind it.
  std::vector<std::uint32_t> sent(size, 0), received(size);
  std::iota(received.begin(), received.end(), 1u);
  Halo halo(processes().plan(std::vector<std::size_t>(size, 1)), sent, received);
  std::vector<double> values(size + 1, -1);
  for (const double add : {0.0, 100.0}) {
    values[0] = rank + add;
    halo.refresh(std::vector{Halo::column(std::span(values))});
    for (std::size_t r = 0; r < size; ++r) EXPECT_EQ(values[r + 1], static_cast<double>(r) + add);
  }
}

/// Every row has two elements; rows belong to the processes by turns of unequal length, the first has none.
TEST(Slabs, BringRowsFromTheirOwners) {
  const auto size = static_cast<std::size_t>(processes().size());
  std::vector<std::size_t> border{0, 0};
  for (std::size_t r = 1; r < size; ++r) border.push_back(border.back() + 2 * r + 1);
  const std::size_t rows = border.back();
  for (const bool is_ring : {false, true}) {
    const Slabs slabs(processes(), border, is_ring);
    const RowRange own = slabs.own();
    const std::vector<RowRange> needed = slabs.around({4, 3});
    const auto is_in = [](const std::vector<RowRange>& ranges, std::size_t row) {
      return std::any_of(ranges.begin(), ranges.end(),
                         [&](const RowRange& range) { return row >= range.begin && row < range.end; });
    };
    std::vector<double> values(2 * rows, -1);
    for (std::size_t row = own.begin; row < own.end; ++row)
      values[row] = static_cast<double>(row), values[rows + row] = 100.0 + static_cast<double>(row);
    Halo halo = slabs.halo(needed, [&](std::size_t row, std::vector<std::uint32_t>& elements) {
      elements.push_back(static_cast<std::uint32_t>(row));
      elements.push_back(static_cast<std::uint32_t>(rows + row));
    });
    halo.refresh(std::vector{Halo::column(std::span(values))});
    for (std::size_t row = 0; row < rows; ++row) {
      const bool is_known = is_in(needed, row) || is_in({own}, row);
      EXPECT_EQ(values[row], is_known ? static_cast<double>(row) : -1);
      EXPECT_EQ(values[rows + row], is_known ? 100.0 + static_cast<double>(row) : -1);
    }
  }
}

TEST(Processes, ThrowTogetherWhatTheFirstOfThemHasMet) {
  const int last = processes().size() - 1;
  EXPECT_NO_THROW(together(processes(), [] {}));
  try {
    together(processes(), [&] {
      if (processes().rank() + 1 >= last)
        throw NumericalError(
            {.what = "at " + std::to_string(processes().rank()), .term = "", .place = "", .advice = ""});
    });
    FAIL() << "some have failed";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.report().what, "at " + std::to_string(last - 1));
  }
}

std::vector<Vector3> places(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<Vector3> points;
  for (std::size_t n = 0; n < count; ++n)
    points.push_back({random.uniform(0, 1), random.uniform(0, 2), random.uniform(-1, 0)});
  return points;
}

/// The weight in the part of each process. \param weight of each of these points
std::vector<double> weights_of_parts(const Partition& partition, std::span<const Vector3> points,
                                     std::uint64_t weight) {
  Votes votes{
      .least = {}, .largest = {}, .sum = std::vector<std::uint64_t>(static_cast<std::size_t>(processes().size()))};
  for (const Vector3& x : points) votes.sum[static_cast<std::size_t>(partition.rank_of(x))] += weight;
  processes().join(votes);
  return {votes.sum.begin(), votes.sum.end()};
}

TEST(Partition, GivesEachProcessItsShareOfTheWeight) {
  const auto partition = processes().partition();
  const std::size_t each = 500;
  const std::vector<Vector3> own = places(static_cast<std::uint64_t>(processes().rank()) + 1, each);
  partition->cut(own, std::vector<double>(each, 1.0));
  for (const double weight : weights_of_parts(*partition, own, 1)) EXPECT_NEAR(weight, each, 0.05 * each);
}

TEST(Partition, FollowsTheWeights) {
  const auto partition = processes().partition();
  std::vector<Vector3> own = places(static_cast<std::uint64_t>(processes().rank()) + 1, 500);
  for (Vector3& x : own) x.y += 2 * processes().rank();  // each its own part of space, and a weight of its own
  const auto weight = static_cast<std::uint64_t>(processes().rank() + 1);
  partition->cut(own, std::vector<double>(own.size(), static_cast<double>(weight)));
  const double mean = 250.0 * (processes().size() + 1);
  for (const double found : weights_of_parts(*partition, own, weight)) EXPECT_NEAR(found, mean, 0.05 * mean);
}

TEST(Partition, CutsThroughTheLayersOfALattice) {
  const auto partition = processes().partition();
  std::vector<Vector3> own;
  for (int n = 0; n < 9 * 9 * 9 && processes().is_first(); ++n)
    own.push_back({0.1 * (n % 9), 0.1 * (n / 9 % 9), 0.1 * (n / 81)});
  partition->cut(own, std::vector<double>(own.size(), 1.0));
  const double mean = 729.0 / processes().size();  // a layer is 81
  for (const double weight : weights_of_parts(*partition, own, 1))
    EXPECT_NEAR(weight, mean, std::max(3.0, 0.02 * mean));
}

TEST(Partition, IsTheSameForAllAndFindsThePartsOfABox) {
  const auto partition = processes().partition();
  // All points are at the first process.
  const std::vector<Vector3> own = places(3, processes().is_first() ? 1000 : 0);
  partition->cut(own, std::vector<double>(own.size(), 1.0));
  for (const Vector3& x : places(9, 200)) {
    const int rank = partition->rank_of(x);
    EXPECT_EQ(processes().value_from_first(rank), rank);
    const Vector3 half{0.1, 0.1, 0.1};
    std::vector<int> ranks;
    partition->ranks_of(x - half, x + half, ranks);
    EXPECT_THAT(ranks, Contains(rank));
    for (const Vector3& corner : {x - half, x + half}) EXPECT_THAT(ranks, Contains(partition->rank_of(corner)));
    partition->ranks_of(x, x, ranks);
    EXPECT_THAT(ranks, Contains(rank));
  }
}

}  // namespace
}  // namespace talus
