// SPDX-License-Identifier: Apache-2.0
/// Charts are drawn on pages with four pixels a unit, and looked at where the axes say that something must be.
#include "io/figure/chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "io/figure/legend.hpp"
#include "io/figure/picture.hpp"

namespace talus::figure {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
constexpr double scale = 4;
const Rectangle plot{50, 20, 200, 100};

/// A chart with axes 0..10 in both directions.
Chart chart(std::vector<Series> series) {
  return {.x = {.low = 0, .high = 10}, .y = {.low = 0, .high = 10}, .series = std::move(series), .legend = false};
}

class Drawn {
 public:
  explicit Drawn(const Chart& chart) : frame_(frame_of(chart, plot)), picture_(drawn(chart, plot, 270, 150, scale)) {}

  /// The pixel at a place in data, moved by (dx, dy) units.
  Colour at(double x, double y, double dx = 0, double dy = 0) const {
    return picture_.at(static_cast<int>(scale * (frame_.x(x) + dx)), static_cast<int>(scale * (frame_.y(y) + dy)));
  }
  const Picture& picture() const { return picture_; }

 private:
  Frame frame_;
  Picture picture_;
};

bool near(const Colour& a, const Colour& b, double tolerance = 0.02) {
  return difference(a, b) < tolerance;
}

/// White, or a line of the grid.
bool blank(const Colour& colour) {
  return near(colour, white, 0.12);
}

TEST(Axes, MapDataToThePage) {
  const Frame frame = frame_of(chart({}), plot);
  EXPECT_DOUBLE_EQ(frame.x(0), plot.x);
  EXPECT_DOUBLE_EQ(frame.x(10), plot.right());
  EXPECT_DOUBLE_EQ(frame.y(0), plot.bottom());
  EXPECT_DOUBLE_EQ(frame.y(7.5), plot.y + 25);
  const Scale decades{1, 100, true, 0, 80};
  EXPECT_DOUBLE_EQ(decades(10), 40);
  EXPECT_DOUBLE_EQ(decades(std::pow(10.0, 1.5)), 60);
  EXPECT_FALSE(std::isfinite(decades(0)));
  EXPECT_FALSE(std::isfinite(decades(-1)));
}

TEST(Axes, AutomaticLimitsHoldAllFiniteDataAndTheirErrors) {
  const Chart c{.series = {Line{.x = {3, 5, nan, 4}, .y = {20, 30, 99, infinity}, .spread = {1, 8, 1, 1}},
                           Line{.x = {3, 4}, .y = {18, 19}, .spread = {8, 0}}}};
  const Frame frame = frame_of(c, plot);
  EXPECT_EQ(frame.x.low, 3);
  EXPECT_EQ(frame.x.high, 5);
  EXPECT_LT(frame.y.low, 10);
  EXPECT_GT(frame.y.low, 8);
  EXPECT_GT(frame.y.high, 38);
  EXPECT_LT(frame.y.high, 40);
}

TEST(Axes, BeginAtZeroUnderBarsAndDataThatComeNearIt) {
  EXPECT_EQ(frame_of({.series = {Bars{.edges = {7, 8, 9}, .heights = {50, 51}}}}, plot).y.low, 0);
  EXPECT_EQ(frame_of({.series = {Line{.x = {0, 40}, .y = {1, 50}}}}, plot).y.low, 0);
  EXPECT_EQ(frame_of({.series = {Line{.x = {0, 40}, .y = {1, 50}}}}, plot).x.high, 40);
  EXPECT_GT(frame_of({.series = {Line{.x = {0, 1}, .y = {49, 50}}}}, plot).y.low, 48);
  const Frame flat = frame_of({.series = {Line{.x = {1, 1}, .y = {-3, -3}}}}, plot);
  EXPECT_LT(flat.x.low, 1);
  EXPECT_GT(flat.x.high, 1);
  EXPECT_LT(flat.y.low, -3);
  EXPECT_GT(flat.y.high, -3);
}

TEST(Axes, LogarithmicLimitsSkipWhatHasNoLogarithm) {
  const Chart c{.y = {.logarithmic = true}, .series = {Line{.x = {0, 1, 2, 3}, .y = {0, -5, 1e-3, 1e4}}}};
  const Frame frame = frame_of(c, plot);
  EXPECT_LE(frame.y.low, 1e-3);
  EXPECT_GT(frame.y.low, 1e-4);
  EXPECT_GE(frame.y.high, 1e4);
}

TEST(Chart, LineGoesThroughItsPoints) {
  const Drawn d(chart({Line{.x = {0, 10}, .y = {1, 9}, .colour = green, .width = 2}}));
  for (const double x : {1.3, 4.7, 8.2}) {
    EXPECT_TRUE(near(d.at(x, 1 + 0.8 * x), green)) << x;
    EXPECT_TRUE(blank(d.at(x, 1 + 0.8 * x, 0, -4))) << x;
    EXPECT_TRUE(blank(d.at(x, 1 + 0.8 * x, 0, 4))) << x;
  }
}

TEST(Chart, LineIsBrokenWhereDataAreMissing) {
  for (const double missing : {nan, infinity}) {
    const Drawn d(chart({Line{.x = {1, 3, 5, 7, 9}, .y = {5, 5, missing, 5, 5}, .colour = blue, .width = 2}}));
    EXPECT_TRUE(near(d.at(1.7, 5), blue));
    EXPECT_TRUE(near(d.at(8.3, 5), blue));
    for (const double x : {3.3, 4.7, 5.3, 6.7}) EXPECT_TRUE(blank(d.at(x, 5))) << x;
  }
}

TEST(Chart, SpreadIsABandAboutTheLine) {
  const Drawn d(chart({Line{.x = {1, 9}, .y = {5, 5}, .spread = {1, 2}, .colour = vermillion, .width = 2}}));
  const Colour band = mix(white, vermillion, 0.22);
  EXPECT_TRUE(near(d.at(5.3, 5), vermillion));
  EXPECT_TRUE(near(d.at(5.3, 6.3), band));
  EXPECT_TRUE(near(d.at(5.3, 3.7), band));
  EXPECT_TRUE(near(d.at(1.3, 5.9), band));
  EXPECT_TRUE(blank(d.at(1.3, 6.3)));
  EXPECT_TRUE(blank(d.at(5.3, 6.8)));
  EXPECT_TRUE(blank(d.at(9.3, 5)));
}

TEST(Chart, SpreadHasAGapWhereDataAreMissing) {
  const Drawn d(chart({Line{.x = {1, 3, 5, 7, 9}, .y = {4, 4, nan, 4, 4}, .spread = {1, 1, 1, 1, 1}, .colour = blue}}));
  const Colour band = mix(white, blue, 0.22);
  EXPECT_TRUE(near(d.at(1.7, 4.3), band));
  EXPECT_TRUE(near(d.at(8.3, 4.3), band));
  for (const double x : {3.3, 5.3, 6.7}) EXPECT_TRUE(blank(d.at(x, 4.3))) << x;
}

TEST(Chart, BarsStandOnZeroBetweenTheirEdges) {
  const Drawn d(chart({Bars{.edges = {1, 3, 4, 6}, .heights = {4, 0, 8}, .colour = sky}}));
  const Colour fill = mix(white, sky, 0.35);
  EXPECT_TRUE(near(d.at(2.3, 0.7), fill));
  EXPECT_TRUE(near(d.at(2.3, 3.7), fill));
  EXPECT_TRUE(blank(d.at(2.3, 4.3)));
  EXPECT_TRUE(blank(d.at(3.5, 0.7)));
  EXPECT_TRUE(near(d.at(5.3, 7.7), fill));
  EXPECT_TRUE(blank(d.at(6.3, 0.7)));
}

TEST(Chart, StepIsAnOutline) {
  const Drawn d(chart({Bars{.edges = {1, 3, 6}, .heights = {4, 8}, .colour = blue, .filled = false}}));
  EXPECT_TRUE(near(d.at(2.3, 4), blue));
  EXPECT_TRUE(near(d.at(4.7, 8), blue));
  EXPECT_TRUE(near(d.at(3, 6.3), blue));
  EXPECT_TRUE(near(d.at(1, 2.3), blue));
  EXPECT_TRUE(near(d.at(6, 2.3), blue));
  EXPECT_TRUE(blank(d.at(2.3, 2.3)));
  EXPECT_TRUE(blank(d.at(3, 2.3)));
}

TEST(Chart, NothingLeavesThePlot) {
  const Drawn d(chart({Line{.x = {-50, 50}, .y = {-50, 50}, .spread = {9, 9}, .colour = blue, .width = 3},
                       Bars{.edges = {-5, 20}, .heights = {30}, .colour = green}}));
  for (const Colour& colour : {blue, green}) {
    for (int y = 0; y < static_cast<int>(scale * (plot.y - 1)); ++y) {
      for (int x = 0; x < d.picture().width; ++x) ASSERT_FALSE(near(d.picture().at(x, y), colour, 0.2));
    }
    for (int y = 0; y < d.picture().height; ++y) {
      ASSERT_FALSE(near(d.picture().at(static_cast<int>(scale * (plot.right() + 2)), y), colour, 0.2));
    }
  }
}

TEST(Chart, EmptyDataDrawAxes) {
  for (const Chart& empty : {Chart{}, Chart{.series = {Line{}, Bars{}}},
                             Chart{.x = {.logarithmic = true}, .series = {Line{.x = {-1}, .y = {nan}}}}}) {
    const Picture picture = drawn(empty, plot, 270, 150, scale);
    int on_axes = 0;
    for (int x = 210; x < 990; ++x) on_axes += near(picture.at(x, 480), ink, 0.5);
    for (int y = 90; y < 470; ++y) on_axes += near(picture.at(200, y), ink, 0.5);
    EXPECT_EQ(on_axes, 780 + 380);
  }
}

TEST(Chart, RefusesDescriptionsThatMakeNoSense) {
  EXPECT_THROW(check({.series = {Line{.x = {1, 2}, .y = {1}}}}), std::invalid_argument);
  EXPECT_THROW(check({.series = {Line{.x = {1, 2}, .y = {1, 2}, .spread = {1}}}}), std::invalid_argument);
  EXPECT_THROW(check({.series = {Bars{.edges = {1, 2}, .heights = {1, 2}}}}), std::invalid_argument);
  EXPECT_THROW(frame_of({.x = {.low = 3, .high = 2}}, plot), std::invalid_argument);
  EXPECT_THROW(frame_of({.y = {.low = 0, .high = 2, .logarithmic = true}}, plot), std::invalid_argument);
  EXPECT_NO_THROW(frame_of({.y = {.low = 50}, .series = {Line{.x = {0, 1}, .y = {1, 2}}}}, plot));
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

TEST(Legend, KeepsOffLines) {
  Chart c = chart({Line{.x = {0, 10}, .y = {9, 9}, .label = "here", .colour = purple}});
  const int before = drawn(c, plot, 270, 150, scale).count(purple);
  ASSERT_GT(before, 100);
  c.legend = true;
  EXPECT_GE(drawn(c, plot, 270, 150, scale).count(purple), before) << "a box on the line would pale it";
}

TEST(Legend, ShowsTheColoursOfTheSeries) {
  Chart c = chart({Line{.x = {0, 1}, .y = {0, 0}, .label = "one", .colour = purple, .width = 2}});
  const int without = drawn(c, plot, 270, 150, scale).count(purple);
  c.legend = true;
  EXPECT_GT(drawn(c, plot, 270, 150, scale).count(purple), without + 100);
}

}  // namespace
}  // namespace talus::figure
