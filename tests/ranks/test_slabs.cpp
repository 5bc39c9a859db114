// SPDX-License-Identifier: Apache-2.0
#include "ranks/slabs.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace talus {
namespace {

/// One of several processes, for what it finds by itself.
class OneOf final : public Ranks {
 public:
  OneOf(int rank, int size) : Ranks(rank, size) {}
  void join(Votes&) const override {}
  void add_up(std::span<double>) const override {}
  std::string gather(const std::string& own) const override { return own; }
  std::string gather_at_first(const std::string& own) const override { return own; }
  void from_first(std::span<std::byte>) const override {}
  std::unique_ptr<Plan> plan(std::span<const std::size_t>) const override { return nullptr; }
  std::unique_ptr<Partition> partition() const override { return nullptr; }
  int on_this_machine() const override { return 1; }
  [[noreturn]] void abort(int status) const override { std::exit(status); }
};

std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<RowRange>& ranges) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const RowRange& range : ranges) found.emplace_back(range.begin, range.end);
  return found;
}
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(Slabs, OfOneProcessAreAllRows) {
  const Slabs slabs(20);
  EXPECT_EQ(pairs({slabs.own()}), (Pairs{{0, 20}}));
  EXPECT_EQ(pairs(slabs.around({3, 4})), (Pairs{{0, 20}}));
}

TEST(Slabs, ReachAsFarAsThereAreRows) {
  const OneOf second(1, 3);
  const Slabs line(second, {0, 5, 12, 20}, false), ring(second, {0, 5, 12, 20}, true);
  EXPECT_EQ(pairs(line.around({})), (Pairs{{5, 12}}));
  EXPECT_EQ(pairs(line.around({2, 3})), (Pairs{{3, 15}}));
  EXPECT_EQ(pairs(line.around({9, 30})), (Pairs{{0, 20}}));
  EXPECT_EQ(pairs(ring.around({2, 3})), (Pairs{{3, 15}}));
  EXPECT_EQ(pairs(ring.around({7, 0})), (Pairs{{0, 12}, {18, 20}}));
  EXPECT_EQ(pairs(ring.around({1, 10})), (Pairs{{0, 2}, {4, 20}}));
  EXPECT_EQ(pairs(ring.around({7, 7})), (Pairs{{0, 20}}));
  EXPECT_TRUE(Slabs(second, {0, 5, 5, 20}, false).around({}).empty());
}

TEST(Slabs, IncludeARowTheShorterWay) {
  const OneOf second(1, 3);
  const auto reach_of = [](const Slabs& slabs, std::size_t row) {
    Slabs::Reach reach;
    slabs.include(row, reach);
    return std::pair(reach.before, reach.after);
  };
  const Slabs line(second, {0, 5, 12, 20}, false), ring(second, {0, 5, 12, 20}, true);
  EXPECT_EQ(reach_of(line, 7), std::pair(std::size_t{0}, std::size_t{0}));
  EXPECT_EQ(reach_of(line, 1), std::pair(std::size_t{4}, std::size_t{0}));
  EXPECT_EQ(reach_of(line, 19), std::pair(std::size_t{0}, std::size_t{8}));
  EXPECT_EQ(reach_of(ring, 19), std::pair(std::size_t{6}, std::size_t{0}));
  EXPECT_EQ(reach_of(ring, 13), std::pair(std::size_t{0}, std::size_t{2}));
}

TEST(Slabs, BlocksAreCountedFromTheFirstRow) {
  ThreadTeam team;
  Pairs found;
  const std::vector<RowRange> ranges{{0, 3}, {7, 21}};
  for_each_block(team, ranges, 8, [&](std::size_t block, std::size_t begin, std::size_t end) {
    EXPECT_EQ(begin / 8, block);
    found.emplace_back(begin, end);
  });
  EXPECT_EQ(found, (Pairs{{0, 3}, {7, 8}, {8, 16}, {16, 21}}));
}

}  // namespace
}  // namespace talus
