// SPDX-License-Identifier: Apache-2.0
/// Labels: Unicode text with a little markup, set in DejaVu Sans.
///
///     *v*           slanted, for variables
///     v_{f} m^{2}   subscript, superscript (the braces are needed: front_speed stays as it is)
///     ṽ t̃ W̃         a letter with a tilde or another combining mark, composed or not: the mark is centred on the
///     letter
///
/// The slant is made here, so that the pictures need only the upright font and look the same everywhere.
#pragma once

#include <cairo/cairo.h>

#include <string_view>

#include "io/figure/colour.hpp"

namespace talus::figure {

struct TextStyle {
  double size = 10;  ///< units
  Colour colour = ink;
  bool bold = false;
};

enum class Align { left, centre, right };

/// Width from the pen's start to its end; ascent and descent of what is drawn, about the baseline. Units.
struct TextExtent {
  double width = 0, ascent = 0, descent = 0;
};

TextExtent text_extent(cairo_t* context, std::string_view text, const TextStyle& style);

/// Draws on a baseline through (x, y), turned anticlockwise by `angle` (radians) about that point.
void draw_text(cairo_t* context, std::string_view text, double x, double y, const TextStyle& style,
               Align align = Align::left, double angle = 0);

}  // namespace talus::figure
