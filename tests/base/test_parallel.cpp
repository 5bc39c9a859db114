// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace talus {
namespace {

TEST(ForEach, VisitsEveryIndexOnce) {
  for (const int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.size(), threads);
    for (const std::size_t count : {0ul, 1ul, 255ul, 256ul, 257ul, 10000ul}) {
      std::vector<int> visits(count, 0);
      for_each(team, count, [&](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), std::size_t{0}), count);
      for (const int visit : visits) EXPECT_EQ(visit, 1);
    }
  }
}

TEST(Reduce, SameBitsForAnyNumberOfThreads) {
  const std::size_t count = 10007;
  auto value = [](std::size_t i) { return std::sin(static_cast<double>(i)) * 1e-3 + 1.0 / (1.0 + double(i)); };
  auto sum = [](double a, double b) { return a + b; };
  ThreadTeam one(1);
  const double expected = reduce(one, count, 0.0, value, sum);
  for (const int threads : {2, 4}) {
    ThreadTeam team(threads);
    for (int repeat = 0; repeat < 50; ++repeat) EXPECT_EQ(reduce(team, count, 0.0, value, sum), expected);
  }
}

/// Loops so short that most threads come too late for them, and find the next one open or none.
TEST(ForEach, ShortLoopsOneAfterTheOther) {
  ThreadTeam team(8);
  std::vector<long> sums(4 * chunk_size, 0);
  long expected = 0;
  for (int loop = 0; loop < 2000; ++loop) {
    const std::size_t count = (1 + static_cast<std::size_t>(loop) % 4) * chunk_size;
    for_each(team, count, [&](std::size_t i) { sums[i] += loop; });
    expected += loop * static_cast<long>(count);
  }
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0l), expected);
}

TEST(ForEach, PassesOnTheExceptionOfTheLowestTask) {
  ThreadTeam team(2);
  try {
    team.run(100, [](std::size_t task) {
      if (task % 2 == 1) throw std::runtime_error(std::to_string(task));
    });
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "1");
  }
  std::size_t done = 0;
  for_each(team, 10, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 10u);
}

}  // namespace
}  // namespace talus
