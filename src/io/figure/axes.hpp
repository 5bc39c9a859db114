// SPDX-License-Identifier: Apache-2.0
/// The frame of a panel: from data to page, axis lines, ticks, numbers, names, the colour bar.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/figure/canvas.hpp"

namespace talus::figure {

struct Ticks {
  std::vector<double> major;        ///< increasing, within the axis
  std::vector<std::string> labels;  ///< one for each major tick; labels times `factor` is the value
  std::string factor;               ///< "×10^{-6}" for very small or large numbers, or empty
};

/// The smallest of 1, 2 or 5 times a power of ten that divides `range` into at most `most` steps.
/// \throws std::invalid_argument unless range is positive and finite and most >= 1
double nice_step(double range, int most);

/// The largest of 1, 2 or 5 times a power of ten that is not above `most`, for bars and arrows that show a scale.
/// \throws std::invalid_argument unless most is positive and finite
double nice_length(double most);

/// Multiples of the nice step in [low, high]; with `most` below 3 there may be none. \throws std::invalid_argument
/// unless low < high, both finite
Ticks linear_ticks(double low, double high, int most);

/// With the minus sign of typography.
std::string with_minus(std::string_view number);

inline constexpr TextStyle tick_style{.size = 8.5}, label_style{.size = 9.5}, legend_style{.size = 8.5};

/// Maps data between `low` and `high` to the page between `begin` and `end`, evenly.
struct Scale {
  double low = 0, high = 1;
  double begin = 0, end = 1;

  /// Position on the page; not finite where the value is not.
  double operator()(double value) const;
};

/// About one tick every `spacing` units, but no fewer than two where the axis has that many round numbers.
Ticks ticks_for(const Scale& scale, double spacing);

/// "label (unit)", or what there is of it.
std::string axis_title(const std::string& label, const std::string& unit);

/// What stands around a plot, in units.
struct Margins {
  double left = 0, right = 0, top = 0, bottom = 0;
};

/// The two axes of a plot.
struct Frame {
  Scale x = {}, y = {};  ///< x: begin left, end right; y: begin at the bottom, end at the top
  std::string x_title = {}, y_title = {};
};

Margins frame_margins(cairo_t* context, const Frame& frame);
void draw_frame(cairo_t* context, const Frame& frame);

/// A colour bar right of a plot.
struct ColourBar {
  double low = 0, high = 1;
  std::string title = {};
};

double colour_bar_width(cairo_t* context, const ColourBar& bar, double height);
void draw_colour_bar(cairo_t* context, const ColourBar& bar, const Rectangle& plot);

/// What an arrow means: one of `length` units with its label next to it. It stands below the corner right of a plot,
/// below the colour bar, and covers nothing of the plot.
struct ArrowKey {
  std::string label = {};
  double length = 0;
  Colour colour = ink;
};

/// Right of and below the plot.
Margins arrow_key_margins(cairo_t* context, const ArrowKey& key);
/// \param below the plot's lower edge, at least `arrow_key_margins(key).bottom`, units
void draw_arrow_key(cairo_t* context, const ArrowKey& key, const Rectangle& plot, double below);

/// A point on the page that is better not covered.
struct Obstacle {
  double x = 0, y = 0;
};

/// Of the corners and the middles of the sides of `plot`, the box of that size that covers the fewest obstacles; the
/// corners come first, from the upper right, when several are as good. It lies in `plot` if it fits.
Rectangle emptiest_place(const Rectangle& plot, double width, double height, const std::vector<Obstacle>& obstacles);

/// Adds points that fill the rectangle, so that nothing else is put there.
void block(const Rectangle& rectangle, std::vector<Obstacle>& obstacles);

}  // namespace talus::figure
