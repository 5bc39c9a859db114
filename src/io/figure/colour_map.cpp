// SPDX-License-Identifier: Apache-2.0
/// Viridis and cividis stand here as 33 equally spaced colours, fitted by least squares so that straight lines between
/// them follow the published tables. Sources: van der Walt & Smith, "mpl-colormaps" (2015); Nuñez, Anderton & Renslow,
/// PLOS ONE 13 (2018) e0199239. The diverging map is computed: Moreland, "Diverging Color Maps for Scientific
/// Visualization", ISVC 2009.
#include "io/figure/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace talus::figure {

namespace {

using Table = std::array<unsigned, 33>;

constexpr Table viridis_table = {
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086, 0x3f4989, 0x3b528b, 0x375a8d, 0x33638d,
    0x2f6a8e, 0x2c728e, 0x297a8e, 0x26818e, 0x23898e, 0x21908d, 0x1f988b, 0x1e9f88, 0x21a685, 0x27ae80, 0x31b57b,
    0x3dbc74, 0x4cc26c, 0x5cc963, 0x6ece58, 0x81d44c, 0x96d840, 0xabdc32, 0xc0df24, 0xd5e219, 0xeae519, 0xfde725};

constexpr Table cividis_table = {
    0x00204d, 0x00265a, 0x002c6a, 0x003070, 0x05366e, 0x203c6d, 0x2c426c, 0x38476b, 0x414d6b, 0x4a536b, 0x52596c,
    0x595e6d, 0x61646f, 0x686a71, 0x6f7073, 0x757676, 0x7c7b78, 0x848279, 0x8c8879, 0x948e78, 0x9c9477, 0xa49b76,
    0xaca174, 0xb4a872, 0xbdaf6f, 0xc5b66c, 0xcebd68, 0xd7c463, 0xe0cb5e, 0xe9d358, 0xf2da51, 0xfce246, 0xffea46};

Colour interpolated(const Table& table, double t) {
  const double place = t * static_cast<double>(table.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), table.size() - 2);
  return mix(rgb(table[below]), rgb(table[below + 1]), place - static_cast<double>(below));
}

/// sRGB of a colour in CIE L*a*b* (white D65).
Colour from_lab(double lightness, double a, double b) {
  auto inverse = [](double f) {
    return f > 6.0 / 29.0 ? f * f * f : 3.0 * (6.0 / 29.0) * (6.0 / 29.0) * (f - 4.0 / 29);
  };
  const double fy = (lightness + 16.0) / 116.0;
  const double x = 0.9505 * inverse(fy + a / 500.0), y = inverse(fy), z = 1.089 * inverse(fy - b / 200.0);
  auto encode = [](double linear) {
    linear = std::clamp(linear, 0.0, 1.0);
    return linear > 0.0031308 ? 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055 : 12.92 * linear;
  };
  return {encode(3.2406 * x - 1.5372 * y - 0.4986 * z), encode(-0.9689 * x + 1.8758 * y + 0.0415 * z),
          encode(0.0557 * x - 0.2040 * y + 1.0570 * z), 1.0};
}

/// Moreland's polar form of L*a*b*: magnitude, saturation angle, hue. Each half runs straight in it from the published
/// end colour to an unsaturated middle of magnitude 88, the hue spun on the way to the middle.
Colour diverging(double t) {
  struct Polar {
    double magnitude, saturation, hue;
  };
  constexpr Polar cool{80.0, 1.08, -1.1}, warm{80.0, 1.08, 0.5};
  constexpr double middle = 88.0;
  const Polar& end = t < 0.5 ? cool : warm;
  const double inward = t < 0.5 ? 2.0 * t : 2.0 * (1.0 - t);
  const double spin = end.saturation * std::sqrt(middle * middle - end.magnitude * end.magnitude) /
                      (end.magnitude * std::sin(end.saturation));
  const double magnitude = end.magnitude + inward * (middle - end.magnitude);
  const double saturation = end.saturation * (1.0 - inward);
  const double hue = end.hue + inward * (end.hue > -std::numbers::pi / 3.0 ? spin : -spin);
  return from_lab(magnitude * std::cos(saturation), magnitude * std::sin(saturation) * std::cos(hue),
                  magnitude * std::sin(saturation) * std::sin(hue));
}

}  // namespace

Colour colour_at(ColourMap map, double t) {
  t = t > 0.0 ? std::min(t, 1.0) : 0.0;
  switch (map) {
    case ColourMap::viridis:
      return interpolated(viridis_table, t);
    case ColourMap::cividis:
      return interpolated(cividis_table, t);
    case ColourMap::grey:
      return mix(white, rgb(0x3a3f47), t);
    case ColourMap::cool_warm:
      return diverging(t);
  }
  return ink;
}

}  // namespace talus::figure
