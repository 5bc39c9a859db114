// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/enstad.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/unit.hpp"
#include "physics/granular/en1991.hpp"

namespace talus::granular {
namespace {

constexpr double pi = std::numbers::pi, weight = 15e3;

/// What lies in a cone, or in a wedge of unit length, below an arc through the walls at a height above the apex, by
/// sums of levels. \param arc half its angle
double volume_below(double shape, double half_angle, double arc, double height) {
  const double half_width = height * std::tan(half_angle), radius = half_width / std::sin(arc);
  const double centre = height - radius * std::cos(arc), crown = centre + radius;
  constexpr int levels = 200'000;
  double sum = 0;
  for (int n = 0; n < levels; ++n) {
    const double z = (n + 0.5) * crown / levels;
    const double reach =
        z < height ? z * std::tan(half_angle) : std::sqrt(std::max(0.0, radius * radius - (z - centre) * (z - centre)));
    sum += shape == en1991::conical ? pi * reach * reach : 2 * reach;
  }
  return sum * crown / levels;
}

double section(double shape, double half_width) {
  return shape == en1991::conical ? pi * half_width * half_width : 2 * half_width;
}

TEST(Enstad, AWholeHopperIsInBalance) {
  const double internal = 35 * degree, friction = 0.3, angle = 25 * degree, low = 0.2, top = 1.3, above = 20e3;
  const double wall = std::atan(friction), beta = 0.5 * (wall + std::asin(std::sin(wall) / std::sin(internal)));
  for (const double shape : {en1991::wedge, en1991::conical}) {
    const auto bearing = arc_bearing(shape, angle, friction, internal);
    ASSERT_TRUE(bearing);
    const auto pressure = [&](double x) { return arc_pressure(*bearing, weight, x, top, above); };
    double walls = 0;
    constexpr int bands = 20'000;
    for (int n = 0; n < bands; ++n) {
      const double x = low + (n + 0.5) * (top - low) / bands;
      const double around = shape == en1991::conical ? 2 * pi * x * std::tan(angle) : 2;
      // Of the wall along a height dx the pressure bears tan theta upwards, its friction mu.
      walls += pressure(x) * (std::tan(angle) + friction) * around * (top - low) / bands;
    }
    const auto on_arc = [&](double x) {
      return pressure(x) * bearing->on_arc / bearing->on_wall * section(shape, x * std::tan(angle));
    };
    const double within = volume_below(shape, angle, beta + angle, top) - volume_below(shape, angle, beta + angle, low);
    EXPECT_NEAR(walls + on_arc(low), on_arc(top) + weight * within, 1e-6 * weight * within) << "S = " << shape;
    // The load at the level of the top is what presses on the arc, and the cap that lies below it.
    const double cap = volume_below(shape, angle, beta + angle, top) -
                       section(shape, top * std::tan(angle)) * top / (shape == en1991::conical ? 3 : 2);
    EXPECT_NEAR(on_arc(top) + weight * cap, above * section(shape, top * std::tan(angle)), 1e-4 * weight)
        << "S = " << shape;
  }
}

TEST(Enstad, TheWallMobilisesCoulombsFriction) {
  const double internal = 33 * degree;
  for (const double friction : {0.1, 0.38, 0.6}) {
    const double wall = std::atan(friction), beta = 0.5 * (wall + std::asin(std::sin(wall) / std::sin(internal)));
    const auto bearing = arc_bearing(en1991::conical, 10 * degree, friction, internal);
    ASSERT_TRUE(bearing);
    EXPECT_NEAR(std::sin(internal) * std::sin(2 * beta) / bearing->on_wall, friction, 1e-12);
  }
}

TEST(Enstad, HasTheNumbersOfASmoothHopper) {
  // beta = 0, delta = theta = 30 degrees: X = S 1/(1 - 1/2), Y as the volume of an arc that meets its walls squarely.
  const auto cone = arc_bearing(en1991::conical, 30 * degree, 0, 30 * degree),
             wedge = arc_bearing(en1991::wedge, 30 * degree, 0, 30 * degree);
  EXPECT_NEAR(cone->exponent, 4, 1e-12);
  EXPECT_NEAR(wedge->exponent, 2, 1e-12);
  EXPECT_NEAR(cone->weight * std::cos(30 * degree), 16 * (1 - std::cos(30 * degree)), 1e-12);
  EXPECT_NEAR(wedge->weight * std::cos(30 * degree), 2 * pi / 3, 1e-12);
  EXPECT_NEAR(arc_bearing(1.5, 30 * degree, 0, 30 * degree)->weight, 0.5 * (cone->weight + wedge->weight), 1e-12);
}

TEST(Enstad, TendsToWalkersInANarrowHopper) {
  // Friction in proportion to the slope: arcs become flat, the stress across them the vertical one.
  const double internal = 30 * degree, top = 1, above = 2e3;
  const auto apart = [&](double tangent, double height) {
    const double angle = std::atan(tangent), friction = 0.5 * tangent;
    const ConeBearing level = cone_in_flow(angle, friction, internal);
    const double walker = level.ratio * cone_stress(level, weight, height, top, above);
    const auto arcs = arc_bearing(en1991::conical, angle, friction, internal);
    return arc_pressure(*arcs, weight, height, top, above) / walker - 1;
  };
  for (const double height : {0.2, 0.9}) {
    EXPECT_LT(std::abs(apart(0.004, height)), 1e-3);
    EXPECT_NEAR(apart(0.002, height) / apart(0.004, height), 0.25, 0.01);
  }
}

TEST(Enstad, AtTheApexForgetsWhatIsAbove) {
  const auto bearing = arc_bearing(en1991::conical, 20 * degree, 0.3, 35 * degree);
  const double X = bearing->exponent;
  ASSERT_GT(X, 1);
  const auto pressure = [&](double x, double above) { return arc_pressure(*bearing, weight, x, 1, above); };
  // In proportion to the height, as in Jenike's radial field; the surcharge falls off as x^X.
  const double radial = bearing->on_wall * weight * bearing->weight / (X - 1);
  EXPECT_NEAR(pressure(1e-3, 50e3) / 1e-3, radial, 1e-6 * radial);
  EXPECT_NEAR((pressure(0.1, 50e3) - pressure(0.1, 40e3)) / (pressure(0.2, 50e3) - pressure(0.2, 40e3)),
              std::pow(0.5, X), 1e-9);
  EXPECT_EQ(pressure(1, 0), 0) << "the surface of the bed";
}

TEST(Enstad, HasNoArcOfHalfACircle) {
  // As rough as the grains beta is 45 degrees and half of theirs.
  EXPECT_TRUE(arc_bearing(en1991::conical, 29.9 * degree, 1, 30 * degree));
  EXPECT_FALSE(arc_bearing(en1991::conical, 30.1 * degree, 1, 30 * degree));
  EXPECT_EQ(arc_bearing(en1991::conical, 20 * degree, 1, 30 * degree)->exponent,
            arc_bearing(en1991::conical, 20 * degree, std::tan(30 * degree), 30 * degree)->exponent)
      << "no rougher than they";
}

}  // namespace
}  // namespace talus::granular
