// SPDX-License-Identifier: Apache-2.0
/// A page to draw on with cairo, its PNG, colours and text. Lengths on a page are in *units*: a text of size 10 reads
/// well; the scale says how many pixels a unit has. The page's y runs downwards.
#pragma once

#include <cairo/cairo.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

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

/// Viridis, in which equal steps look equal (van der Walt & Smith 2015; published as CC0), at `t`; outside [0, 1] the
/// colour of the nearer end. Within 1.1/255 of the published table of 256 colours.
Colour colour_at(double t);

/// A rectangle on the page, in units.
struct Rectangle {
  double x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Rectangle&) const = default;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
  bool contains(double px, double py) const { return px >= x && px <= right() && py >= y && py <= bottom(); }
};

/// A page's pixels, row by row from the top, four bytes each: blue, green, red, unused.
struct Pixels {
  int width = 0, height = 0;
  std::string bytes = {};
};

class Canvas {
 public:
  /// A white page of width x height units, rounded to whole pixels.
  /// \throws std::invalid_argument if a side is no number from 1 to 32767 pixels
  Canvas(double width, double height, double scale);

  cairo_t* context() const { return context_.get(); }

  /// The page as a PNG file's bytes. \throws std::runtime_error if cairo failed in any drawing before
  std::string png() const;

  /// \throws std::runtime_error as png()
  Pixels pixels() const;

 private:
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> context_;
};

/// Keeps the pen's settings and clip for the length of a block.
class Saved {
 public:
  explicit Saved(cairo_t* context) : context_(context) { cairo_save(context_); }
  ~Saved() { cairo_restore(context_); }
  Saved(const Saved&) = delete;
  Saved& operator=(const Saved&) = delete;

 private:
  cairo_t* context_;
};

void set_colour(cairo_t* context, const Colour& colour);
/// Colour and width of the lines to come.
void set_pen(cairo_t* context, const Colour& colour, double width);
void fill_rectangle(cairo_t* context, const Rectangle& rectangle, const Colour& colour);
/// Strokes one straight line with the pen as set.
void stroke_line(cairo_t* context, double x0, double y0, double x1, double y1);
/// Strokes a line with a filled head of `head` units at its end.
void stroke_arrow(cairo_t* context, double x0, double y0, double x1, double y1, double head);

// Labels: Unicode text with a little markup, set in DejaVu Sans.
//
//     *v*           slanted, for variables
//     v_{f} m^{2}   subscript, superscript (the braces are needed: front_speed stays as it is)
//     ṽ t̃ W̃         a letter with a tilde or another combining mark, composed or not, centred on the letter
//
// The slant is made here, so that the pictures need only the upright font and look the same everywhere.

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
