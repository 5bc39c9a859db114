// SPDX-License-Identifier: Apache-2.0
/// Curves, described: a chart is a list of series on two axes. Values are in the axes' units as they shall be read.
/// Values that are not finite are skipped (a line is broken there); on a logarithmic axis those not above zero as well.
#pragma once

#include <cairo/cairo.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/figure/axes.hpp"
#include "io/figure/canvas.hpp"

namespace talus::figure {

struct Axis {
  std::string label = {};                     ///< with the markup of text.hpp
  std::string unit = {};                      ///< empty for numbers
  std::optional<double> low = {}, high = {};  ///< automatic where left out
  bool logarithmic = false;
};

/// A line through points, with a band of ± spread about it if that is given. The colour left out is the next of the
/// palette, in every kind of series; an empty label keeps a series out of the legend.
struct Line {
  std::vector<double> x = {}, y = {};
  std::vector<double> spread = {};  ///< one for each point, e.g. the standard deviation; empty: no band
  std::string label = {};
  std::optional<Colour> colour = {};
  Dash dash = Dash::solid;
  double width = 1.5;   ///< units
  bool marked = false;  ///< a disc at each point
};

/// A histogram: bars between edges, or their outline as one stepped line.
struct Bars {
  std::vector<double> edges = {}, heights = {};  ///< one more edge than heights
  std::string label = {};
  std::optional<Colour> colour = {};
  bool filled = true;
};

using Series = std::variant<Line, Bars>;

struct Chart {
  std::string title = {};
  Axis x = {}, y = {};
  std::vector<Series> series = {};
  double aspect = 0.72;  ///< height over width of the plot, if the figure leaves it free
  bool legend = true;
};

/// Checks that the columns of each series have the same length. \throws std::invalid_argument naming the series
void check(const Chart& chart);

/// The axes over a plot: given limits, or those that hold all finite data with a little room; bars stand on zero, and
/// data that come near zero from above begin there. \throws std::invalid_argument if given limits make no axis
Frame frame_of(const Chart& chart, const Rectangle& plot);

/// What the axes need around the plot.
Margins margins(cairo_t* context, const Chart& chart, const Rectangle& plot);

/// Draws into `plot`; numbers and names of the axes stand around it.
void draw(cairo_t* context, const Chart& chart, const Rectangle& plot);

}  // namespace talus::figure
