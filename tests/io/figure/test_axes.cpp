// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/random.hpp"
#include "io/figure/axes.hpp"

namespace talus::figure {

namespace {

constexpr Rectangle plot{50, 20, 200, 100};

TEST(Axes, MapDataToThePage) {
  const Scale across{0, 10, plot.x, plot.right()}, up{0, 10, plot.bottom(), plot.y};
  EXPECT_DOUBLE_EQ(across(0), plot.x);
  EXPECT_DOUBLE_EQ(across(10), plot.right());
  EXPECT_DOUBLE_EQ(up(0), plot.bottom());
  EXPECT_DOUBLE_EQ(up(7.5), plot.y + 25);
}

TEST(Legend, StandsWhereItCoversNothing) {
  std::vector<Obstacle> obstacles;
  auto crowd = [&](double x0, double x1, double y0, double y1) {
    for (double x = x0; x < x1; x += 5) {
      for (double y = y0; y < y1; y += 5) obstacles.push_back({x, y});
    }
  };
  EXPECT_GT(emptiest_place(plot, 40, 20, obstacles).x, 200) << "the upper right comes first";
  crowd(50, 250, 20, 60);  // the upper half
  Rectangle box = emptiest_place(plot, 40, 20, obstacles);
  EXPECT_GT(box.x, 200);
  EXPECT_GT(box.y, 90);
  crowd(200, 250, 60, 120);  // and the lower right
  box = emptiest_place(plot, 40, 20, obstacles);
  EXPECT_LT(box.x, 60);
  EXPECT_GT(box.y, 90);
  block(box, obstacles);
  const Rectangle next = emptiest_place(plot, 40, 20, obstacles);
  EXPECT_TRUE(next.x > box.right() || next.right() < box.x || next.y > box.bottom() || next.bottom() < box.y);
}

}  // namespace

namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(NiceStep, IsTheSmallestOneTwoOrFiveThatSuffices) {
  EXPECT_EQ(nice_step(10, 5), 2);
  EXPECT_EQ(nice_step(10, 4), 5);
  EXPECT_EQ(nice_step(10, 1), 10);
  EXPECT_EQ(nice_step(10.1, 1), 20);
  EXPECT_EQ(nice_step(0.3, 3), 0.1);
  EXPECT_EQ(nice_step(6e-7, 4), 2e-7);
  EXPECT_EQ(nice_step(4.2e9, 5), 1e9);
}

TEST(NiceLength, IsTheLargestOneTwoOrFiveNotAbove) {
  EXPECT_EQ(nice_length(1), 1);
  EXPECT_EQ(nice_length(1.99), 1);
  EXPECT_EQ(nice_length(4.9), 2);
  EXPECT_EQ(nice_length(0.05), 0.05);
  EXPECT_EQ(nice_length(730), 500);
}

TEST(LinearTicks, CoverTheRangeInStepsOfOneTwoOrFive) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const double size = std::pow(10.0, random.uniform(-9, 9));
    const double low = size * random.uniform(-2, 2), high = low + size * random.uniform(0.1, 3);
    const int most = 3 + trial % 9;
    const Ticks ticks = linear_ticks(low, high, most);
    const double step = nice_step(high - low, most);
    const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 || std::abs(digit - 5) < 1e-9) << step;
    ASSERT_FALSE(ticks.major.empty());
    EXPECT_LE(ticks.major.size(), static_cast<std::size_t>(most) + 1);
    EXPECT_GE(ticks.major.front(), low);
    EXPECT_LE(ticks.major.back(), high);
    EXPECT_LT(ticks.major.front() - low, step * (1 + 1e-9));
    EXPECT_LT(high - ticks.major.back(), step * (1 + 1e-9));
    for (std::size_t i = 1; i < ticks.major.size(); ++i) {
      EXPECT_NEAR(ticks.major[i] - ticks.major[i - 1], step, 1e-6 * step);
    }
    EXPECT_EQ(ticks.labels.size(), ticks.major.size());
  }
}

TEST(LinearTicks, AreWrittenWithTheDigitsThatTellThemApart) {
  const Ticks ticks = linear_ticks(-0.3, 0.3, 6);
  EXPECT_THAT(ticks.labels, ElementsAre("−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"));
  EXPECT_EQ(ticks.factor, "");
  EXPECT_THAT(linear_ticks(0, 60000, 3).labels, ElementsAre("0", "20000", "40000", "60000"));
}

TEST(LinearTicks, ShareAFactorWhenVerySmallOrLarge) {
  const Ticks small = linear_ticks(0, 0.005, 5);
  EXPECT_THAT(small.labels, ElementsAre("0", "1", "2", "3", "4", "5"));
  EXPECT_EQ(small.factor, "×10^{-3}");
  const Ticks large = linear_ticks(-2.5e6, 2.5e6, 2);
  EXPECT_THAT(large.labels, ElementsAre("0"));
  EXPECT_THAT(linear_ticks(0, 2.5e6, 5).labels, ElementsAre("0.0", "0.5", "1.0", "1.5", "2.0", "2.5"));
}

TEST(Ticks, RefuseWhatIsNoAxis) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(linear_ticks(1, 1, 5), std::invalid_argument);
  EXPECT_THROW(linear_ticks(0, infinity, 5), std::invalid_argument);
  EXPECT_THROW(linear_ticks(0, std::nan(""), 5), std::invalid_argument);
  EXPECT_THROW(nice_step(0, 5), std::invalid_argument);
  EXPECT_THROW(nice_length(-1), std::invalid_argument);
}

}  // namespace

}  // namespace talus::figure
