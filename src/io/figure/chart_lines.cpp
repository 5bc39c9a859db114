// SPDX-License-Identifier: Apache-2.0
/// Lines, with a band about them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/figure/chart_layers.hpp"

namespace talus::figure {

namespace {

constexpr double band_opacity = 0.22, marker_radius = 2;  // units

/// Fills between two curves, one polygon for each stretch without gaps.
void fill_between(ChartPage& page, const std::vector<double>& x, const std::vector<double>& low,
                  const std::vector<double>& high, const Colour& colour) {
  set_colour(page.context, with_alpha(colour, band_opacity));
  auto there = [&](std::size_t i) { return page.place(x[i], low[i]).there() && page.place(x[i], high[i]).there(); };
  for (std::size_t begin = 0, end = 0; begin < x.size(); begin = end + 1) {
    for (end = begin; end < x.size() && there(end);) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      const auto above = page.place(x[i], high[i]), below = page.place(x[i], low[i]);
      cairo_line_to(page.context, above.x, above.y);
      page.obstacles.push_back({above.x, above.y});
      page.obstacles.push_back({below.x, below.y});
    }
    for (std::size_t i = end; i-- > begin;) cairo_line_to(page.context, page.frame.x(x[i]), page.frame.y(low[i]));
    cairo_fill(page.context);
  }
}

/// Points along a straight stretch, dense enough that no legend passes between them.
void keep_clear(ChartPage& page, const ChartPage::Place& from, const ChartPage::Place& to) {
  const int pieces = std::clamp(static_cast<int>(std::hypot(to.x - from.x, to.y - from.y) / 4), 1, 400);
  for (int k = 1; k <= pieces; ++k) {
    const double t = static_cast<double>(k) / pieces;
    page.obstacles.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
}

}  // namespace

void paint(ChartPage& page, const Line& line, const Colour& colour) {
  const Saved saved(page.context);
  page.clip();
  if (!line.spread.empty()) {
    std::vector<double> low = line.y, high = line.y;
    for (std::size_t i = 0; i < low.size(); ++i) low[i] -= line.spread[i], high[i] += line.spread[i];
    fill_between(page, line.x, low, high, colour);
  }
  set_pen(page.context, colour, line.width, line.dash);
  ChartPage::Place last{NAN, NAN};
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    const auto point = page.place(line.x[i], line.y[i]);
    if (point.there() && last.there()) {
      cairo_line_to(page.context, point.x, point.y);
      keep_clear(page, last, point);
    } else if (point.there()) {
      cairo_move_to(page.context, point.x, point.y);
    }
    last = point;
  }
  cairo_stroke(page.context);
  for (std::size_t i = 0; line.marked && i < line.x.size(); ++i) {
    const auto point = page.place(line.x[i], line.y[i]);
    if (!point.there()) continue;
    cairo_arc(page.context, point.x, point.y, marker_radius, 0, 2 * std::numbers::pi);
    cairo_fill(page.context);
    page.obstacles.push_back({point.x, point.y});
  }
  page.name(line.label, [colour, dash = line.dash, width = line.width, band = !line.spread.empty()](
                            cairo_t* context, const Rectangle& swatch) {
    if (band) fill_rectangle(context, swatch, with_alpha(colour, band_opacity));
    set_pen(context, colour, width, dash);
    const double middle = swatch.y + 0.5 * swatch.height;
    stroke_line(context, swatch.x, middle, swatch.right(), middle);
  });
}

}  // namespace talus::figure
