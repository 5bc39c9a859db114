// SPDX-License-Identifier: Apache-2.0
/// The legend of a panel, put where it covers the least.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/figure/canvas.hpp"

namespace talus::figure {

struct LegendEntry {
  std::string label = {};
  std::function<void(cairo_t*, const Rectangle& swatch)> draw;
};

/// A point on the page that is better not covered.
struct Obstacle {
  double x = 0, y = 0;
};

/// Of the corners and the middles of the sides of `plot`, the box of that size that covers the fewest obstacles; the
/// corners come first, from the upper right, when several are as good. It lies in `plot` if it fits.
Rectangle emptiest_place(const Rectangle& plot, double width, double height, const std::vector<Obstacle>& obstacles);

/// Draws the legend in the emptiest place and adds its box to the obstacles. Nothing is drawn without entries.
void draw_legend(cairo_t* context, const std::vector<LegendEntry>& entries, const Rectangle& plot,
                 std::vector<Obstacle>& obstacles);

/// Adds points that fill the rectangle, so that nothing else is put there.
void block(const Rectangle& rectangle, std::vector<Obstacle>& obstacles);

}  // namespace talus::figure
