// SPDX-License-Identifier: Apache-2.0
#include "io/figure/figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/random.hpp"
#include "io/figure/picture.hpp"

namespace talus::figure {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Particles and a picture of them without axes; 1 m is 100 pixels, the window 2 m wide and 1 m high.
struct Scene {
  std::vector<Vector3> positions;
  std::vector<double> radii;
  ParticlePicture picture = {};

  Scene(std::vector<Vector3> p, std::vector<double> r) : positions(std::move(p)), radii(std::move(r)) {
    picture.positions = positions;
    picture.radii = radii;
    picture.axes = false;
    picture.window = Window{0, 2, 0, 1};
  }
  Scene(const Scene&) = delete;

  Picture drawn() const { return figure::drawn(picture, {0, 0, 200, 100}, 200, 100); }
};

TEST(ParticlePicture, DiscIsWhereItIsAndAsLargeAsItIs) {
  Scene scene({{0.6, 0.7, 0}}, {0.2});
  scene.picture.colouring = Plain{blue};
  const Picture picture = scene.drawn();
  for (int y = 0; y < 70; ++y) {  // the scale bar is below
    for (int x = 0; x < 120; ++x) {
      const double distance = std::hypot(x + 0.5 - 60, y + 0.5 - 30);
      if (distance < 19) {
        EXPECT_EQ(picture.at(x, y), rgb(0x0072b2)) << x << ' ' << y;
      } else if (distance > 21) {
        EXPECT_EQ(picture.at(x, y), white) << x << ' ' << y;
      }
    }
  }
}

TEST(ParticlePicture, AxesAreEqualInAnyPlot) {
  // A window of 2 m x 1 m in a square plot: 100 pixels a metre, centred.
  Scene scene({{1, 0.5, 0}}, {0.3});
  scene.picture.colouring = Plain{blue};
  const Picture picture = drawn(scene.picture, {0, 0, 200, 200}, 200, 200);
  EXPECT_NEAR(picture.count(blue), std::numbers::pi * 30 * 30, 2 * std::numbers::pi * 30);
  for (const auto& [dx, dy] : {std::pair{28, 0}, {-28, 0}, {0, 28}, {0, -28}}) {
    EXPECT_EQ(picture.at(100 + dx, 100 + dy), rgb(0x0072b2));
  }
  for (const auto& [dx, dy] : {std::pair{32, 0}, {-33, 0}, {0, 32}, {0, -33}}) {
    EXPECT_EQ(picture.at(100 + dx, 100 + dy), white);
  }
}

TEST(ParticlePicture, WindowIsWidenedOnBothSides) {
  // A window of 2 m x 1 m in a plot of 400 x 100: 100 pixels a metre, 100 pixels more on either side.
  Scene scene({{0, 0.5, 0}, {2, 0.5, 0}}, {0.2, 0.2});
  scene.picture.colouring = Plain{blue};
  const Picture picture = drawn(scene.picture, {0, 0, 400, 100}, 400, 100);
  for (const int centre : {100, 300}) {
    EXPECT_EQ(picture.at(centre - 18, 50), rgb(0x0072b2));
    EXPECT_EQ(picture.at(centre + 17, 50), rgb(0x0072b2));
    EXPECT_EQ(picture.at(centre - 23, 50), white);
    EXPECT_EQ(picture.at(centre + 22, 50), white);
  }
}

TEST(ParticlePicture, ViewsShowTheirPlanes) {
  const Vector3 p{1.2, 0.3, 0.8};
  struct Case {
    View view;
    double right, up;
  };
  for (const Case& c : {Case{view_xy, 1.2, 0.3}, Case{view_xz, 1.2, 0.8}}) {
    EXPECT_DOUBLE_EQ(dot(c.view.right, p), c.right);
    EXPECT_DOUBLE_EQ(dot(c.view.up, p), c.up);
  }
}

TEST(ParticlePicture, ViewsAreRightHandedFrames) {
  auto cross = [](const Vector3& a, const Vector3& b) {
    return Vector3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  for (const View& view : {view_xy, view_xz, view_oblique(0.5, 0.4)}) {
    EXPECT_NEAR(norm(view.right), 1, 1e-15);
    EXPECT_NEAR(norm(view.up), 1, 1e-15);
    EXPECT_NEAR(norm(cross(view.right, view.up) - view.toward), 0, 1e-15);
  }
  EXPECT_NEAR(norm(view_oblique(0, 0).toward - view_xz.toward), 0, 1e-15);
  EXPECT_NEAR(norm(view_oblique(0, std::numbers::pi / 2).up - view_xy.up), 0, 1e-15);
}

TEST(ParticlePicture, ColoursByValueOverTheGivenRange) {
  Scene scene({{0.3, 0.5, 0}, {0.9, 0.5, 0}, {1.5, 0.5, 0}}, {0.2, 0.2, 0.2});
  const std::vector<double> values = {200, 500, nan};
  scene.picture.colouring = ByValue{.values = values, .unit = {100, ""}, .low = 0, .high = 10};
  const Picture picture = scene.drawn();
  EXPECT_LT(difference(picture.at(30, 50), colour_at(0.2)), 0.005);
  EXPECT_LT(difference(picture.at(90, 50), colour_at(0.5)), 0.005);
  EXPECT_LT(difference(picture.at(150, 50), pale), 0.005);
}

TEST(ParticlePicture, NearerParticlesCoverFartherOnesWhichArePaler) {
  // Seen along +y: the smaller y, the nearer.
  Scene scene({{0.5, 0, 0.5}, {0.5, 1, 0.5}, {1.5, 1, 0.5}}, {0.1, 0.2, 0.3});
  scene.picture.view = view_xz;
  scene.picture.colouring = Plain{blue};
  scene.picture.depth = true;
  const Picture picture = scene.drawn();
  const Colour near_one = picture.at(55, 55), far_one = picture.at(165, 65);  // away from the highlights
  EXPECT_LT(difference(near_one, blue), 0.005);
  EXPECT_LT(difference(far_one, mix(blue, white, 0.5)), 0.005);
}

TEST(ParticlePicture, ASectionShowsSmallerParticlesOnLargerOnes) {
  for (const bool small_first : {true, false}) {
    const std::vector<double> radii = small_first ? std::vector{0.1, 0.4} : std::vector{0.4, 0.1};
    Scene scene({{1, 0.5, 0}, {1, 0.5, 0}}, radii);
    scene.picture.colouring = ByValue{.values = radii, .low = 0.1, .high = 0.4};
    Scene alone({{1, 0.5, 0}}, {0.1});
    const std::vector<double> value = {0.1};
    alone.picture.colouring = ByValue{.values = value, .low = 0.1, .high = 0.4};
    const Picture both = scene.drawn(), of_small = alone.drawn();
    EXPECT_EQ(both.at(100, 50), of_small.at(100, 50)) << small_first;
  }
}

TEST(ParticlePicture, ParticlesThatAreNowhereAreSkipped) {
  Scene one({{0.5, 0.5, 0}}, {0.2});
  Scene with_nan({{0.5, 0.5, 0}, {nan, 0.2, 0}, {1.5, 0.5, 0}}, {0.2, 0.1, nan});
  EXPECT_EQ(with_nan.drawn().pixels, one.drawn().pixels);
  one.picture.window = with_nan.picture.window = {};
  const Window a = window_of(one.picture), b = window_of(with_nan.picture);
  EXPECT_EQ(a.left, b.left);
  EXPECT_EQ(a.top, b.top);
  one.picture.depth = with_nan.picture.depth = true;
  EXPECT_EQ(with_nan.drawn().pixels, one.drawn().pixels);
}

TEST(ParticlePicture, WindowHoldsEveryDisc) {
  Scene scene({{-3, 5, 0}, {40, 7, 0}}, {1, 2});
  scene.picture.window = {};
  const Window w = window_of(scene.picture);
  EXPECT_LT(w.left, -4);
  EXPECT_GT(w.right, 42);
  EXPECT_LT(w.bottom, 4);
  EXPECT_GT(w.top, 9);
  EXPECT_LT(w.right - w.left, 46 * 1.1);
}

TEST(ParticlePicture, LongCloudsStayReadable) {
  std::vector<Vector3> positions;
  for (int i = 0; i < 500; ++i) positions.push_back({i * 2.0, 0, 0});
  Scene scene(positions, std::vector<double>(500, 0.01));
  scene.picture.window = {};
  scene.picture.colouring = Plain{ink};
  EXPECT_EQ(aspect_of(scene.picture), 0.2);
  const Picture picture = drawn(scene.picture, {0, 0, 200, 40}, 200, 40);
  int columns = 0;  // nearly every column of the cloud shows something, though the discs are 0.002 pixels large
  for (int x = 8; x < 192; ++x) columns += picture.at(x, 20).red < 0.9 || picture.at(x, 19).red < 0.9;
  EXPECT_GT(columns, 170);
}

TEST(ParticlePicture, SlopeIsTheLineZIsZero) {
  Scene scene({}, {});
  scene.picture.view = view_xz;
  scene.picture.window = Window{5, 7, -0.4, 0.6};
  scene.picture.slope = true;
  const Picture picture = scene.drawn();
  EXPECT_LT(difference(picture.at(100, 60), ink), 0.4);
  EXPECT_EQ(picture.at(100, 57), white);
  EXPECT_NE(picture.at(100, 70), white) << "the ground";
}

TEST(ParticlePicture, ArrowsPointAlongTheirVectors) {
  Scene scene({{0.5, 0.5, 0}}, {0.05});
  const std::vector<Vector3> velocities = {{3, 0, 0}};
  scene.picture.colouring = Plain{white};
  scene.picture.arrows = Arrows{.values = velocities, .unit = {1, "m/s"}, .length = 20, .colour = vermillion};
  const Picture picture = scene.drawn();
  EXPECT_LT(difference(picture.at(107, 50), vermillion), 0.1) << "the head ends 60 units to the right";
  EXPECT_LT(picture.at(80, 50).blue, 0.7);
  EXPECT_EQ(picture.at(113, 50), white);
  EXPECT_EQ(picture.at(40, 50), white);

  const std::vector<Vector3> upwards = {{0, 2, 0}};
  scene.picture.arrows->values = upwards;
  const Picture up = scene.drawn();
  EXPECT_LT(difference(up.at(50, 13), vermillion), 0.25) << "the head ends 40 units above";
  EXPECT_EQ(up.at(50, 70), white);
}

TEST(ParticlePicture, ArrowsMayBeginElsewhere) {
  Scene scene({{0.5, 0.5, 0}}, {0.05});
  const std::vector<Vector3> places = {{0.2, 0.8, 0}, {0.2, 0.2, 0}}, velocities = {{2, 0, 0}, {2, 0, 0}};
  scene.picture.colouring = Plain{white};
  scene.picture.arrows = Arrows{.values = velocities, .positions = places, .length = 20, .colour = vermillion};
  const Picture picture = scene.drawn();
  for (const int y : {20, 80}) EXPECT_LT(difference(picture.at(57, y), vermillion), 0.15) << y;
  EXPECT_EQ(picture.at(80, 50), white);
  scene.picture.arrows->positions = std::span(places).first(1);
  EXPECT_THROW(check(scene.picture), std::invalid_argument);
}

TEST(ParticlePicture, ArrowsAreThinnedWhereTheyCrowd) {
  std::vector<Vector3> positions, velocities;
  for (int i = 0; i < 400; ++i) positions.push_back({0.8 + 0.0004 * i, 0.5, 0}), velocities.push_back({0, 1, 0});
  Scene scene(positions, std::vector<double>(400, 0.001));
  scene.picture.colouring = Plain{white};
  scene.picture.arrows = Arrows{.values = velocities, .length = 30, .spacing = 8, .colour = vermillion};
  const Picture picture = scene.drawn();  // 16 pixels wide: two or three arrows
  int arrows = 0;
  for (int x = 70; x < 110; ++x) arrows += picture.at(x, 40).blue < 0.95 && picture.at(x - 1, 40).blue >= 0.95;
  EXPECT_GE(arrows, 2);
  EXPECT_LE(arrows, 3);
}

TEST(ParticlePicture, TheKeyOfArrowsStandsOutsideThePlot) {
  const std::vector<Vector3> velocities = {{0, 0.5, 0}};
  const std::vector<double> values = {3};
  for (const bool axes : {false, true})
    for (const bool bar : {false, true}) {
      Scene scene({{0.5, 0.5, 0}}, {0.05});
      scene.picture.axes = axes;
      if (bar) scene.picture.colouring = ByValue{.values = values, .low = 0, .high = 4};
      scene.picture.arrows = Arrows{.values = velocities, .length = 20, .key = false};
      const Canvas scratch(1, 1, 1);
      const Rectangle plot{50, 20, 200, 100};
      const Margins without = margins(scratch.context(), scene.picture, plot);
      const Picture bare = drawn(scene.picture, plot, 400, 200);
      scene.picture.arrows->key = true;
      const Margins around = margins(scratch.context(), scene.picture, plot);
      const Picture picture = drawn(scene.picture, plot, 400, 200);
      EXPECT_GE(around.right, without.right);
      int changed = 0;
      for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
          if (picture.at(x, y) == bare.at(x, y)) continue;
          ++changed;
          ASSERT_GT(x, plot.right());
          ASSERT_GE(y, plot.bottom());
          ASSERT_LE(x, plot.right() + around.right + 1);
          ASSERT_LE(y, plot.bottom() + around.bottom + 1);
        }
      EXPECT_GT(changed, 50);
    }
}

TEST(ParticlePicture, SegmentsRunFromEndToEnd) {
  Scene scene({}, {});
  scene.picture.segments = {{.from = {0.2, 0.9, 0}, .to = {1.8, 0.9, 0}, .colour = vermillion}};
  const Picture picture = scene.drawn();
  int run = 0;
  for (int x = 0; x < 200; ++x)
    run += difference(picture.at(x, 9), white) > 0.2 || difference(picture.at(x, 10), white) > 0.2;
  EXPECT_NEAR(run, 160, 1);
}

TEST(ParticlePicture, ScaleBarIsAsLongAsItSays) {
  Scene scene({}, {});  // 2 m wide: the largest round length up to 0.28 of that is 0.5 m, 50 pixels
  const Picture picture = scene.drawn();
  int longest = 0;
  for (int y = 0; y < 100; ++y) {
    int run = 0;
    for (int x = 0; x < 200; ++x) {
      run = picture.at(x, y).red < 0.7 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  }
  EXPECT_NEAR(longest, 50, 1);
}

TEST(ParticlePicture, FramesOfAMovieShareTheirScale) {
  Scene a({{0, 0, 0}, {1, 0, 0}}, {0.1, 0.1}), b({{50, 3, 0}, {53, 9, 0}}, {0.1, 0.1});
  a.picture.window = b.picture.window = {};
  std::vector<ParticlePicture> frames = {a.picture, b.picture};
  share_scale(frames);
  const Window &p = *frames[0].window, &q = *frames[1].window;
  EXPECT_DOUBLE_EQ(p.right - p.left, q.right - q.left);
  EXPECT_DOUBLE_EQ(p.top - p.bottom, q.top - q.bottom);
  EXPECT_DOUBLE_EQ(0.5 * (p.left + p.right), 0.5);
  EXPECT_DOUBLE_EQ(0.5 * (q.left + q.right), 51.5);

  frames = {a.picture, b.picture};
  for (ParticlePicture& frame : frames) frame.slope = true;
  const double bottom = window_of(a.picture).bottom;
  share_scale(frames);
  EXPECT_DOUBLE_EQ(frames[0].window->bottom, bottom) << "stays on its slope";
}

TEST(ParticlePicture, RefusesDescriptionsThatMakeNoSense) {
  Scene scene({{0, 0, 0}}, {0.1, 0.2});
  EXPECT_THROW(check(scene.picture), std::invalid_argument);
  Scene values({{0, 0, 0}}, {0.1});
  values.picture.colouring = ByValue{};
  EXPECT_THROW(check(values.picture), std::invalid_argument);
  Scene colours({}, {});
  colours.picture.colouring = ByValue{.low = 2, .high = 1};
  EXPECT_THROW(check(colours.picture), std::invalid_argument);
  Scene unit({}, {});
  unit.picture.length = {0, "a"};
  EXPECT_THROW(check(unit.picture), std::invalid_argument);
  Scene window({}, {});
  window.picture.window = Window{1, 1, 0, 1};
  EXPECT_THROW(window_of(window.picture), std::invalid_argument);
}

}  // namespace
}  // namespace talus::figure
