// SPDX-License-Identifier: Apache-2.0
/// Points with error bars, and histograms.
#include <algorithm>
#include <numbers>

#include "io/figure/chart_layers.hpp"

namespace talus::figure {

namespace {

constexpr double bar_opacity = 0.35, bar_outline = 0.9, step_width = 1.5, symbol_line = 1.1, error_line = 0.9,
                 cap = 2.2;

void draw_symbol(cairo_t* context, Symbol symbol, double x, double y, double size, const Colour& colour) {
  const double half = 0.5 * size;
  cairo_new_path(context);
  if (symbol == Symbol::disc || symbol == Symbol::circle) {
    cairo_arc(context, x, y, half, 0, 2 * std::numbers::pi);
  } else if (symbol == Symbol::square || symbol == Symbol::open_square) {
    cairo_rectangle(context, x - 0.9 * half, y - 0.9 * half, 1.8 * half, 1.8 * half);
  } else {
    cairo_move_to(context, x, y - 1.15 * half);
    cairo_line_to(context, x + 1.1 * half, y + 0.8 * half);
    cairo_line_to(context, x - 1.1 * half, y + 0.8 * half);
  }
  cairo_close_path(context);
  const bool open = symbol == Symbol::circle || symbol == Symbol::open_square || symbol == Symbol::open_triangle;
  set_colour(context, open ? white : colour);
  cairo_fill_preserve(context);
  set_pen(context, colour, open ? symbol_line : 0.4);
  cairo_stroke(context);
}

/// The lower end of an error bar; one that leaves a logarithmic axis at its bottom ends below what is seen.
double lower_end(const Scale& scale, double value) {
  return scale.logarithmic && !(value > 0) ? scale.low * (scale.low / scale.high) : value;
}

void error_bar(ChartPage& page, const ChartPage::Place& from, const ChartPage::Place& to, bool upright) {
  if (!from.there() || !to.there()) return;
  stroke_line(page.context, from.x, from.y, to.x, to.y);
  const double dx = upright ? cap : 0, dy = upright ? 0 : cap;
  for (const auto& end : {from, to}) {
    stroke_line(page.context, end.x - dx, end.y - dy, end.x + dx, end.y + dy);
    page.obstacles.push_back({end.x, end.y});
  }
}

}  // namespace

void paint(ChartPage& page, const Points& points, const Colour& colour) {
  const Saved saved(page.context);
  {
    const Saved unclipped(page.context);
    page.clip();
    set_pen(page.context, with_alpha(colour, 0.8), error_line);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      const double x = points.x[i], y = points.y[i];
      if (!page.place(x, y).there()) continue;
      if (!points.x_error.empty()) {
        const double error = points.x_error[i];
        error_bar(page, page.place(lower_end(page.frame.x, x - error), y), page.place(x + error, y), false);
      }
      if (!points.y_error.empty()) {
        const double error = points.y_error[i];
        error_bar(page, page.place(x, lower_end(page.frame.y, y - error)), page.place(x, y + error), true);
      }
    }
  }
  // A symbol on the edge of the plot is drawn whole; the hundredth keeps it there after rounding.
  const Rectangle within{page.plot.x - 0.01, page.plot.y - 0.01, page.plot.width + 0.02, page.plot.height + 0.02};
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const auto point = page.place(points.x[i], points.y[i]);
    if (!point.there() || !within.contains(point.x, point.y)) continue;
    draw_symbol(page.context, points.symbol, point.x, point.y, points.size, colour);
    page.obstacles.insert(page.obstacles.end(), 3, {point.x, point.y});  // a symbol weighs more than a piece of line
  }
  page.name(points.label, [colour, symbol = points.symbol, size = points.size](cairo_t* context, const Rectangle& box) {
    draw_symbol(context, symbol, box.x + 0.5 * box.width, box.y + 0.5 * box.height, size, colour);
  });
}

void paint(ChartPage& page, const Bars& bars, const Colour& colour) {
  const Saved saved(page.context);
  page.clip();
  const double floor = page.frame.y.logarithmic ? page.plot.bottom() : page.frame.y(0);
  const std::size_t count = bars.heights.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double left = page.frame.x(bars.edges[i]), right = page.frame.x(bars.edges[i + 1]);
    const double height = page.frame.y(bars.heights[i]), top = std::isfinite(height) ? height : floor;
    if (!std::isfinite(left) || !std::isfinite(right)) continue;
    if (bars.filled) {
      fill_rectangle(page.context, {left, std::min(floor, top), right - left, std::abs(top - floor)},
                     with_alpha(colour, bar_opacity));
      // fill_rectangle ends the path, so each bar has its own outline.
      set_pen(page.context, colour, bar_outline);
      cairo_rectangle(page.context, left, top, right - left, floor - top);
      cairo_stroke(page.context);
    } else {
      if (i == 0) cairo_move_to(page.context, left, floor);
      cairo_line_to(page.context, left, top);
      cairo_line_to(page.context, right, top);
      if (i + 1 == count) cairo_line_to(page.context, right, floor);
    }
    for (double x = left; x <= right; x += 4) page.obstacles.push_back({x, top});
  }
  set_pen(page.context, colour, step_width);
  cairo_stroke(page.context);
  page.name(bars.label, [colour, filled = bars.filled](cairo_t* context, const Rectangle& swatch) {
    if (filled) fill_rectangle(context, swatch, with_alpha(colour, bar_opacity));
    set_pen(context, colour, filled ? bar_outline : step_width);
    if (filled) cairo_rectangle(context, swatch.x, swatch.y, swatch.width, swatch.height);
    cairo_stroke(context);
    const double middle = swatch.y + 0.5 * swatch.height;
    if (!filled) stroke_line(context, swatch.x, middle, swatch.right(), middle);
  });
}

}  // namespace talus::figure
