// SPDX-License-Identifier: Apache-2.0
/// A page to draw on with cairo, and its PNG. Lengths on a page are in *units*: a text of size 10 reads well; the scale
/// says how many pixels a unit has. The page's y runs downwards.
#pragma once

#include <cairo/cairo.h>

#include <memory>
#include <string>

#include "io/figure/colour.hpp"

namespace talus::figure {

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

}  // namespace talus::figure
