// SPDX-License-Identifier: Apache-2.0
#include "io/figure/legend.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "io/figure/axes.hpp"

namespace talus::figure {

namespace {
constexpr double swatch_width = 18, gap = 6, row = 12.5, inset = 5, clearance = 6;
}

Rectangle emptiest_place(const Rectangle& plot, double width, double height, const std::vector<Obstacle>& obstacles) {
  const double left = plot.x + clearance, right = plot.right() - clearance - width;
  const double top = plot.y + clearance, bottom = plot.bottom() - clearance - height;
  const double middle = plot.x + 0.5 * (plot.width - width), centre = plot.y + 0.5 * (plot.height - height);
  const std::array<std::pair<double, double>, 8> places = {{{right, top},
                                                            {left, top},
                                                            {right, bottom},
                                                            {left, bottom},
                                                            {middle, top},
                                                            {middle, bottom},
                                                            {right, centre},
                                                            {left, centre}}};
  Rectangle best{right, top, width, height};
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const auto& [x, y] : places) {
    const Rectangle grown{x - 3, y - 3, width + 6, height + 6};
    const auto covered = static_cast<std::size_t>(std::count_if(
        obstacles.begin(), obstacles.end(), [&](const Obstacle& point) { return grown.contains(point.x, point.y); }));
    if (covered < fewest) {
      fewest = covered;
      best = {x, y, width, height};
    }
  }
  return best;
}

void draw_legend(cairo_t* context, const std::vector<LegendEntry>& entries, const Rectangle& plot,
                 std::vector<Obstacle>& obstacles) {
  if (entries.empty()) return;
  double text_width = 0;
  for (const LegendEntry& entry : entries) {
    text_width = std::max(text_width, text_extent(context, entry.label, legend_style).width);
  }
  const double height = row * static_cast<double>(entries.size()) + 2 * inset - 2;
  const Rectangle box = emptiest_place(plot, text_width + swatch_width + gap + 2 * inset, height, obstacles);
  fill_rectangle(context, box, with_alpha(white, 0.85));
  double y = box.y + inset;
  for (const LegendEntry& entry : entries) {
    {
      const Saved saved(context);
      entry.draw(context, {box.x + inset, y, swatch_width, row - 2});
    }
    draw_text(context, entry.label, box.x + inset + swatch_width + gap, y + 0.5 * (row - 2) + 0.36 * legend_style.size,
              legend_style);
    y += row;
  }
  block(box, obstacles);
}

void block(const Rectangle& rectangle, std::vector<Obstacle>& obstacles) {
  // Dense enough that a box put on any part of it counts more of these than of the data elsewhere.
  for (double x = rectangle.x; x <= rectangle.right(); x += 2) {
    for (double y = rectangle.y; y <= rectangle.bottom(); y += 2) obstacles.push_back({x, y});
  }
}

}  // namespace talus::figure
