// SPDX-License-Identifier: Apache-2.0
/// What a chart's axes must hold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/figure/chart.hpp"

namespace talus::figure {

namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

/// The range of what was shown to it.
struct Extent {
  bool logarithmic = false;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool roomy = false;  ///< something reaches beyond its values, as a bar does

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  void add(double value) {
    if (shows(value)) low = std::min(low, value), high = std::max(high, value);
  }
  void add(double value, double error) { add(value), add(value - error), add(value + error); }
};

/// A point counts only where both its values are seen.
void add_line(const Line& line, Extent& x, Extent& y) {
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!x.shows(line.x[i]) || !y.shows(line.y[i])) continue;
    x.add(line.x[i]);
    y.add(line.y[i], line.spread.empty() ? 0 : line.spread[i]);
  }
}

void add_series(const Series& series, Extent& x, Extent& y) {
  std::visit(Overloaded{[&](const Line& s) { add_line(s, x, y); },
                        [&](const Bars& s) {
                          for (const double edge : s.edges) x.add(edge);
                          for (const double height : s.heights) y.add(height);
                          y.add(0);  // bars stand on it
                          x.roomy = true;
                        }},
             series);
}

/// Limits with room around the data, where they are not given.
void choose(const Axis& axis, Extent extent, Scale& scale) {
  const bool empty = !(extent.low <= extent.high);
  double low = empty ? (axis.logarithmic ? 1 : 0) : extent.low,
         high = empty ? (axis.logarithmic ? 10 : 1) : extent.high;
  const double room = extent.roomy ? 0.05 : 0;
  if (axis.logarithmic) {
    if (low == high) low /= 2, high *= 2;
    const double factor = std::pow(high / low, room);
    low /= factor, high *= factor;
  } else {
    if (low == high) {
      const double half = low == 0 ? 1 : 0.1 * std::abs(low);
      low -= half, high += half;
    }
    const bool on_zero = low >= 0 && low <= 0.25 * high;
    const double range = high - (on_zero ? 0 : low);
    low = on_zero ? 0 : low - room * range;
    high += room * range;
  }
  scale.logarithmic = axis.logarithmic;
  scale.low = axis.low.value_or(low);
  scale.high = axis.high.value_or(high);
  // A given limit on the far side of the data would leave no axis.
  if (!axis.high && scale.high <= scale.low) scale.high = axis.logarithmic ? 10 * scale.low : scale.low + 1;
  if (!axis.low && scale.high <= scale.low) scale.low = axis.logarithmic ? scale.high / 10 : scale.high - 1;
  if (!(scale.low < scale.high) || !std::isfinite(scale.high - scale.low) || (axis.logarithmic && !(scale.low > 0))) {
    throw std::invalid_argument(fmt::format("axis '{}': no {} axis from {} to {}", axis.label,
                                            axis.logarithmic ? "logarithmic" : "linear", scale.low, scale.high));
  }
}

void check_lengths(const std::string& label, std::size_t count, std::initializer_list<std::size_t> lengths,
                   std::initializer_list<std::size_t> optional = {}) {
  const bool same = std::all_of(lengths.begin(), lengths.end(), [&](std::size_t n) { return n == count; }) &&
                    std::all_of(optional.begin(), optional.end(), [&](std::size_t n) { return n == 0 || n == count; });
  if (!same) throw std::invalid_argument(fmt::format("series '{}': columns of different lengths", label));
}

}  // namespace

void check(const Chart& chart) {
  for (const Series& series : chart.series) {
    std::visit(Overloaded{[](const Line& s) { check_lengths(s.label, s.x.size(), {s.y.size()}, {s.spread.size()}); },
                          [](const Bars& s) {
                            if (!s.edges.empty() || !s.heights.empty())
                              check_lengths(s.label, s.heights.size() + 1, {s.edges.size()});
                          }},
               series);
  }
}

Frame frame_of(const Chart& chart, const Rectangle& plot) {
  check(chart);
  Extent x{.logarithmic = chart.x.logarithmic}, y{.logarithmic = chart.y.logarithmic, .roomy = true};
  for (const Series& series : chart.series) add_series(series, x, y);
  Frame frame;
  choose(chart.x, x, frame.x);
  choose(chart.y, y, frame.y);
  frame.x.begin = plot.x, frame.x.end = plot.right();
  frame.y.begin = plot.bottom(), frame.y.end = plot.y;
  frame.x_title = axis_title(chart.x.label, chart.x.unit);
  frame.y_title = axis_title(chart.y.label, chart.y.unit);
  return frame;
}

}  // namespace talus::figure
