// SPDX-License-Identifier: Apache-2.0
/// The frame of a panel: from data to page, axis lines, ticks, numbers, names, and the colour bar.
#pragma once

#include <string>

#include "io/figure/canvas.hpp"
#include "io/figure/colour_map.hpp"
#include "io/figure/text.hpp"
#include "io/figure/ticks.hpp"

namespace talus::figure {

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

/// What an arrow means: one of `length` units with its label beside it. It stands below the corner right of a plot,
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

}  // namespace talus::figure
