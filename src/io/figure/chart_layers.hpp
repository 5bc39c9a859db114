// SPDX-License-Identifier: Apache-2.0
/// How each kind of series is put on the page: chart_lines.cpp and chart_bars.cpp.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "io/figure/chart.hpp"
#include "io/figure/legend.hpp"

namespace talus::figure {

/// The page while a chart is drawn: what the legend shall say, and where it shall not stand.
struct ChartPage {
  cairo_t* context;
  Frame frame;
  Rectangle plot;
  std::vector<Obstacle> obstacles = {};
  std::vector<LegendEntry> entries = {};

  struct Place {
    double x, y;
    bool there() const { return std::isfinite(x) && std::isfinite(y); }
  };
  Place place(double x, double y) const { return {frame.x(x), frame.y(y)}; }

  void clip() const {
    cairo_rectangle(context, plot.x, plot.y, plot.width, plot.height);
    cairo_clip(context);
  }
  void name(const std::string& label, std::function<void(cairo_t*, const Rectangle&)> swatch) {
    if (!label.empty()) entries.push_back({label, std::move(swatch)});
  }
};

void paint(ChartPage& page, const Line& line, const Colour& colour);
void paint(ChartPage& page, const Bars& bars, const Colour& colour);

}  // namespace talus::figure
