// SPDX-License-Identifier: Apache-2.0
/// Colours of the pictures: sRGB components, and a palette that people with colour blindness tell apart.
#pragma once

#include <array>
#include <cstddef>

namespace talus::figure {

/// sRGB components and opacity, each in [0, 1].
struct Colour {
  double red = 0, green = 0, blue = 0, alpha = 1;
  constexpr bool operator==(const Colour&) const = default;
};

/// From the usual hexadecimal writing: rgb(0x0072b2).
constexpr Colour rgb(unsigned hex) {
  return {((hex >> 16) & 255u) / 255.0, ((hex >> 8) & 255u) / 255.0, (hex & 255u) / 255.0, 1.0};
}

/// From a (t = 0) to b (t = 1), component by component.
constexpr Colour mix(const Colour& a, const Colour& b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue),
          a.alpha + t * (b.alpha - a.alpha)};
}

constexpr Colour with_alpha(Colour colour, double alpha) {
  colour.alpha = alpha;
  return colour;
}

inline constexpr Colour white = rgb(0xffffff);
inline constexpr Colour ink = rgb(0x222222);    ///< text and axes
inline constexpr Colour muted = rgb(0x6b7280);  ///< what stands back: reference lines, arrows
inline constexpr Colour pale = rgb(0xc3c8cf);   ///< particles that are not the subject
inline constexpr Colour blue = rgb(0x0072b2), vermillion = rgb(0xd55e00), green = rgb(0x009e73), purple = rgb(0xcc79a7),
                        orange = rgb(0xe69f00), sky = rgb(0x56b4e9);

/// The series' colours in order (Okabe & Ito, "Color Universal Design", 2008), without their yellow, which is not
/// legible as a line on white.
inline constexpr std::array<Colour, 7> palette = {blue, vermillion, green, purple, orange, sky, ink};

constexpr Colour palette_colour(std::size_t series) {
  return palette[series % palette.size()];
}

}  // namespace talus::figure
