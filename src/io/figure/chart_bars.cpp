// SPDX-License-Identifier: Apache-2.0
/// Histograms.
#include <algorithm>

#include "io/figure/chart_layers.hpp"

namespace talus::figure {

namespace {

constexpr double bar_opacity = 0.35, bar_outline = 0.9, step_width = 1.5;

}  // namespace

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
