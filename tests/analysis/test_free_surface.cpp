// SPDX-License-Identifier: Apache-2.0
/// Surfaces of lattices of known shape: level, wedge, parabola; in a vessel with a stream above.
#include "analysis/free_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/particles.hpp"
#include "base/unit.hpp"

namespace talus {
namespace {

using test::box;
using test::lattice;

constexpr double h = 2e-3, width = 0.2, depth = 0.006, height = 0.2;

template <class Height>
FreeSurface surface_of(Height&& z) {
  const auto points = lattice(width, depth, 0, height, h, [&](double x, double at) { return at < z(x); });
  return free_surface(packing_section(test::particles(points, h), box(width, depth, height), h, 0.5 * h), {0, height});
}

TEST(PackingSection, IsTheMeanOverTheDepth) {
  const auto points = lattice(width, depth, 0, 0.1, h, [](double x, double z) { return x + z < 0.15; });
  const Domain domain = box(width, depth, height, {test::plate(width, 0.06, 0.05, 0.15)});
  const Section section = packing_section(test::particles(points, h), domain, h, 0.5 * h);
  EXPECT_EQ(section.columns, 100u);
  EXPECT_EQ(section.rows, 200u);
  const ParticleField field(test::particles(points, h), domain);
  for (const auto& [column, row] : {std::pair{0, 0}, {50, 58}, {50, 60}, {49, 59}, {70, 5}, {80, 61}, {24, 99}}) {
    double mean = 0;
    const int steps = 48;
    for (int n = 0; n < steps; ++n)
      mean += field.packing({section.x(column), (n + 0.5) * depth / steps, section.z(row)}) / steps;
    EXPECT_NEAR(section.at(column, row), mean, 1e-6) << column << " " << row;
  }
}

TEST(FreeSurface, OfALevelBedIsItsHeight) {
  const FreeSurface surface = surface_of([](double) { return 0.1; });
  ASSERT_EQ(surface.x.size(), 100u);
  for (const double z : surface.z) EXPECT_NEAR(z, 0.1, 0.02 * h);
  EXPECT_NEAR(surface.height(0.0), 0.1, 0.02 * h);
  EXPECT_NEAR(surface.height(0.0507), 0.1, 0.02 * h);
  EXPECT_NEAR(surface_angle(surface, 0.1), 0, 1e-12);
  EXPECT_TRUE(heap_slopes(surface, 10 * h).empty());
}

TEST(FreeSurface, OfAWedgeHasItsSlope) {
  for (const double angle : {10.0, 20.0, 30.0, 35.0}) {
    const double slope = std::tan(angle * degree);
    const FreeSurface surface = surface_of([&](double x) { return 0.03 + slope * x; });
    EXPECT_NEAR(surface_angle(surface, 0.1) / degree, angle, 0.5) << angle;
    const auto slopes = heap_slopes(surface, 10 * h);
    ASSERT_EQ(slopes.size(), 1u) << angle;
    EXPECT_NEAR(slopes[0].angle() / degree, angle, 0.5) << angle;
    EXPECT_GT(slopes[0].length(), 0.9 * width);
    double rms = 0;
    for (std::size_t n = 5; n < 95; ++n) rms += std::pow(surface.z[n] - 0.03 - slope * surface.x[n], 2) / 90;
    EXPECT_LT(std::sqrt(rms), 0.25 * h) << angle;
  }
}

TEST(FreeSurface, OfAParabola) {
  const auto parabola = [](double x) { return 0.12 - 4 * (x - 0.1) * (x - 0.1); };
  const FreeSurface surface = surface_of(parabola);
  for (std::size_t n = 5; n < 95; ++n) EXPECT_NEAR(surface.z[n], parabola(surface.x[n]), 0.5 * h) << n;
  const auto slopes = heap_slopes(surface, 10 * h);
  ASSERT_EQ(slopes.size(), 2u);
  // The line through a stretch of a parabola has the slope in its middle.
  for (const HeapSlope& side : slopes)
    EXPECT_NEAR(side.slope, -8 * (0.5 * (side.from + side.to) - 0.1), 0.01) << side.from << " " << side.to;
  EXPECT_LT(slopes[0].from, 0.01);
  EXPECT_GT(slopes[1].to, 0.19);
  const ReposeAngle found = repose_angle(slopes, 0.1);
  EXPECT_NEAR(found.left, found.right, 1e-9);
}

TEST(FreeSurface, AStreamThatFallsIsNoSurface) {
  const auto points = lattice(width, depth, 0, height, h, [](double x, double z) {
    return z < 0.04 || (std::abs(x - 0.1) < 0.02 && z > 0.05) || (std::abs(x - 0.05) < 0.005 && z > 0.1 && z < 0.12);
  });
  const Section section = packing_section(test::particles(points, h), box(width, depth, height), h, 0.5 * h);
  const FreeSurface from_below = free_surface(section, {0, 0.15, Vessel::Search::from_below});
  for (const double z : from_below.z) EXPECT_NEAR(z, 0.04, 0.1 * h);
  const FreeSurface from_above = free_surface(section, {0, 0.15, Vessel::Search::from_above});
  EXPECT_NEAR(from_above.height(0.05), 0.12, 0.1 * h);

  const auto joined =
      lattice(width, depth, 0, height, h, [](double x, double z) { return z < 0.04 || std::abs(x - 0.1) < 0.02; });
  const FreeSurface hidden =
      free_surface(packing_section(test::particles(joined, h), box(width, depth, height), h, 0.5 * h),
                   {0, 0.15, Vessel::Search::from_below});
  EXPECT_TRUE(std::isnan(hidden.height(0.1)));
  EXPECT_NEAR(hidden.height(0.05), 0.04, 0.1 * h);
}

TEST(HeapSlopes, OfLinesWithANoisyPlateauBetween) {
  FreeSurface surface;
  for (int n = 0; n < 100; ++n) {
    const double x = n + 0.5;
    surface.x.push_back(x);
    surface.z.push_back(x < 40 ? 0.5 * x : x < 60 ? 20 + 0.01 * (n % 2) : 20 - 0.25 * (x - 60));
  }
  const auto slopes = heap_slopes(surface, 10);
  ASSERT_EQ(slopes.size(), 2u);
  EXPECT_NEAR(slopes[0].slope, 0.5, 1e-3);
  EXPECT_NEAR(slopes[1].slope, -0.25, 1e-3);
  const ReposeAngle angle = repose_angle(slopes, 50);
  EXPECT_NEAR(std::tan(angle.left), 0.5, 1e-3);
  EXPECT_NEAR(std::tan(angle.right), 0.25, 1e-3);
  EXPECT_EQ(angle.mean, 0.5 * (angle.left + angle.right));
  EXPECT_EQ(angle.steepest, angle.left);
  EXPECT_TRUE(heap_slopes(surface, 45).empty());
  EXPECT_EQ(repose_angle(std::span(slopes).first(1), 50).mean, angle.left) << "one side alone";
  EXPECT_TRUE(std::isnan(repose_angle({}, 50).mean));
}

TEST(HeapSlopes, EndAtGaps) {
  FreeSurface surface;
  for (int n = 0; n < 60; ++n) {
    surface.x.push_back(n);
    surface.z.push_back(n >= 20 && n < 40 ? std::nan("") : 30 + (n < 20 ? -1.0 : 1.0) * n);
  }
  const auto slopes = heap_slopes(surface, 10);
  ASSERT_EQ(slopes.size(), 2u);
  EXPECT_EQ(slopes[0].from, 0);
  EXPECT_EQ(slopes[0].to, 19);
  EXPECT_EQ(slopes[1].from, 40);
  EXPECT_NEAR(slopes[0].slope, -1, 1e-12);
  EXPECT_NEAR(surface_angle(surface, 30) / degree, 45, 1e-9);
}

TEST(SurfaceAngle, IsAgainstWhatIsLevel) {
  constexpr double tilt = 15 * degree;
  FreeSurface surface;
  for (int n = 0; n <= 100; ++n) {
    const double x = n - 50.0, flank = (x < 0 ? 25 : -20) * degree;  // against the level
    surface.x.push_back(x), surface.z.push_back(x * std::tan(flank + tilt));
  }
  const std::vector<HeapSlope> slopes = heap_slopes(surface, 20, tilt);
  ASSERT_EQ(slopes.size(), 2u);
  const ReposeAngle found = repose_angle(slopes, 0);
  EXPECT_NEAR(found.left / degree, 25, 1e-6);
  EXPECT_NEAR(found.right / degree, 20, 1e-6);
  EXPECT_NEAR(found.steepest / degree, 25, 1e-6);
  EXPECT_NEAR(std::tan(surface_angle(surface, 0, tilt)), 0.5 * (std::tan(25 * degree) + std::tan(20 * degree)), 1e-3);
}

}  // namespace
}  // namespace talus
