// SPDX-License-Identifier: Apache-2.0
#include "io/figure/particle_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/random.hpp"
#include "io/figure/canvas.hpp"

namespace talus::figure {
namespace {

constexpr double width = 60, height = 40, scale = 2, radius = 0.35;

/// The same discs each time, some beyond the page.
template <class Disc>
void draw_discs(Disc&& disc) {
  Random random(3);
  for (int n = 0; n < 4000; ++n) disc(random.uniform(-1, width + 1), random.uniform(-1, height / 2));
}

unsigned blue(const Pixels& pixels, std::size_t n) {
  return static_cast<unsigned char>(pixels.bytes[4 * n]);
}

TEST(Stipple, IsWhatCairoDrawsOneByOne) {
  const Colour colour{0.1, 0.2, 0.3, 0.4};
  Canvas one_by_one(width, height, scale), at_once(width, height, scale);
  set_colour(one_by_one.context(), colour);
  draw_discs([&](double x, double y) {
    cairo_arc(one_by_one.context(), x, y, radius, 0, 2 * std::numbers::pi);
    cairo_fill(one_by_one.context());
  });
  Stipple stipple(at_once.context(), radius, colour);
  draw_discs([&](double x, double y) { stipple.add(x, y); });
  stipple.add(NAN, 3);
  stipple.add(1e300, 3);
  stipple.draw();
  const Pixels a = one_by_one.pixels(), b = at_once.pixels();
  ASSERT_EQ(a.bytes.size(), b.bytes.size());
  double sum_a = 0, sum_b = 0, apart = 0;
  const std::size_t count = a.bytes.size() / 4;
  for (std::size_t n = 0; n < count; ++n) {
    sum_a += blue(a, n);
    sum_b += blue(b, n);
    apart += std::abs(static_cast<double>(blue(a, n)) - blue(b, n));
  }
  const double pixels = static_cast<double>(count);
  EXPECT_LT(sum_a / pixels, 240) << "something is drawn";
  // Cairo's discs are polygons within 0.1 pixels of the circle, which is 6 % of so small a disc.
  EXPECT_NEAR(sum_a / pixels, sum_b / pixels, 2.5) << "of 255";
  EXPECT_LT(apart / pixels, 4) << "pixel by pixel";
  EXPECT_EQ(blue(b, count - 1), 255) << "white where there is no disc";
}

TEST(Stipple, ADiscHasItsArea) {
  Canvas canvas(width, height, scale);
  Stipple stipple(canvas.context(), radius, Colour{0, 0, 0, 1});
  for (int n = 0; n < 10; ++n) stipple.add(5 + 4.07 * n, 10 + 0.13 * n);
  stipple.draw();
  const Pixels pixels = canvas.pixels();
  double dark = 0;
  for (std::size_t n = 0; n < pixels.bytes.size() / 4; ++n) dark += (255.0 - blue(pixels, n)) / 255;
  EXPECT_NEAR(dark, 10 * std::numbers::pi * radius * radius * scale * scale, 0.2);
}

TEST(Stipple, KeepsTheClip) {
  Canvas canvas(width, height, scale);
  cairo_rectangle(canvas.context(), 0, 0, 0.5 * width, height);
  cairo_clip(canvas.context());
  Stipple stipple(canvas.context(), radius, Colour{0, 0, 0, 1});
  for (double x = 0; x < width; x += 0.3) stipple.add(x, 10);
  stipple.draw();
  const Pixels pixels = canvas.pixels();
  const auto at = [&](std::size_t x) { return blue(pixels, 20 * static_cast<std::size_t>(pixels.width) + x); };
  EXPECT_LT(at(30), 60);
  EXPECT_EQ(at(90), 255);
}

}  // namespace
}  // namespace talus::figure
