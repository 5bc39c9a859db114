// SPDX-License-Identifier: Apache-2.0
#include "io/figure/chart.hpp"

#include <type_traits>

#include "io/figure/chart_layers.hpp"

namespace talus::figure {

Margins margins(cairo_t* context, const Chart& chart, const Rectangle& plot) {
  return frame_margins(context, frame_of(chart, plot));
}

void draw(cairo_t* context, const Chart& chart, const Rectangle& plot) {
  ChartPage page{context, frame_of(chart, plot), plot};
  draw_grid(context, page.frame);
  std::size_t next = 0;
  for (const Series& series : chart.series)
    std::visit([&](const auto& s) { paint(page, s, s.colour ? *s.colour : palette_colour(next++)); }, series);
  draw_frame(context, page.frame);
  if (chart.legend) draw_legend(context, page.entries, plot, page.obstacles);
}

}  // namespace talus::figure
