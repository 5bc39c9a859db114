// SPDX-License-Identifier: Apache-2.0
#include "io/figure/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/figure/picture.hpp"

namespace talus::figure {
namespace {

/// CIE lightness of an sRGB colour, 0 to 100.
double lightness(const Colour& colour) {
  auto linear = [](double c) { return c > 0.04045 ? std::pow((c + 0.055) / 1.055, 2.4) : c / 12.92; };
  const double y = 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

// Entries 0, 64, 128, 192 and 255 of the published table of 256 colours.
TEST(ColourMap, FollowsThePublishedTable) {
  const double places[] = {0, 64 / 255.0, 128 / 255.0, 192 / 255.0, 1};
  const unsigned viridis[] = {0x440154, 0x3b528b, 0x21918c, 0x5ec962, 0xfde725};
  for (int k = 0; k < 5; ++k) {
    EXPECT_LT(difference(colour_at(places[k]), rgb(viridis[k])), 2.0 / 255) << k;
  }
}

TEST(ColourMap, GrowsLighterEvenly) {
  const double dark = lightness(colour_at(0)), light = lightness(colour_at(1));
  EXPECT_GT(light - dark, 70);
  for (int k = 1; k <= 50; ++k) {
    EXPECT_GT(lightness(colour_at(k / 50.0)), lightness(colour_at((k - 1) / 50.0)));
    EXPECT_NEAR(lightness(colour_at(k / 50.0)), dark + (light - dark) * k / 50.0, 3.0);
  }
}

TEST(ColourMap, EndsWhereItEnds) {
  EXPECT_EQ(colour_at(-3), colour_at(0));
  EXPECT_EQ(colour_at(7), colour_at(1));
  EXPECT_EQ(colour_at(std::numeric_limits<double>::quiet_NaN()), colour_at(0));
}

// Okabe & Ito's colours stay apart for the commonest colour blindness: simulated deuteranopia after Viénot, Brettel &
// Mollon 1999 (red and green channels merged by their luminance).
TEST(Palette, IsToldApartWithoutSeeingGreen) {
  auto seen = [](const Colour& c) {
    const double merged = 0.29275 * c.red + 0.70725 * c.green;
    return Colour{merged, merged, -0.02234 * c.red + 0.02234 * c.green + c.blue, 1};
  };
  for (std::size_t a = 0; a < palette.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(difference(seen(palette[a]), seen(palette[b])), 0.1) << a << b;
  }
}

}  // namespace
}  // namespace talus::figure
