// SPDX-License-Identifier: Apache-2.0
#include "io/figure/axes.hpp"

#include <gtest/gtest.h>

#include "io/figure/legend.hpp"

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
}  // namespace talus::figure
