// SPDX-License-Identifier: Apache-2.0
#include "io/figure/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace talus::figure {

namespace {

constexpr double tick_length = 3.5, tick_gap = 2.5, title_gap = 5.0, axis_width = 0.8;
constexpr double bar_distance = 8, bar_width = 9, key_gap = 5;

double widest(cairo_t* context, const Ticks& ticks) {
  double width = 0;
  for (const std::string& label : ticks.labels) width = std::max(width, text_extent(context, label, tick_style).width);
  return width;
}

Ticks x_ticks(cairo_t* context, const Scale& scale) {
  const Ticks ticks = ticks_for(scale, 50);
  return ticks_for(scale, std::max(40.0, widest(context, ticks) + 14));
}

}  // namespace

double Scale::operator()(double value) const {
  return begin + (value - low) / (high - low) * (end - begin);
}

Ticks ticks_for(const Scale& scale, double spacing) {
  const double low = std::min(scale.low, scale.high), high = std::max(scale.low, scale.high);
  constexpr int many = 12;
  int most = std::clamp(static_cast<int>(std::abs(scale.end - scale.begin) / spacing), 1, many);
  Ticks ticks;
  do {
    ticks = linear_ticks(low, high, most);
  } while (ticks.major.size() < 2 && ++most <= many);
  return ticks;
}

std::string axis_title(const std::string& label, const std::string& unit) {
  if (unit.empty()) return label;
  return label.empty() ? unit : label + " (" + unit + ")";
}

Margins frame_margins(cairo_t* context, const Frame& frame) {
  const Ticks across = x_ticks(context, frame.x), up = ticks_for(frame.y, 32);
  const double line = 1.25 * tick_style.size;
  Margins margins{tick_length + tick_gap + widest(context, up), 4, 0.5 * line, tick_length + tick_gap + line};
  if (!frame.y_title.empty()) margins.left += title_gap + 1.35 * label_style.size;
  if (!frame.x_title.empty()) margins.bottom += title_gap + 1.2 * label_style.size;
  if (!across.labels.empty()) {
    const double half = 0.5 * text_extent(context, across.labels.back(), tick_style).width;
    margins.right = std::max(margins.right, half - std::abs(frame.x.end - frame.x(across.major.back())) + 2);
  }
  if (!up.factor.empty()) margins.top += line;
  if (!across.factor.empty()) margins.right += 4;
  return margins;
}

void draw_frame(cairo_t* context, const Frame& frame) {
  const double left = frame.x.begin, bottom = frame.y.begin;
  const Ticks across = x_ticks(context, frame.x), up = ticks_for(frame.y, 32);
  set_pen(context, ink, axis_width);
  cairo_move_to(context, left, frame.y.end);
  cairo_line_to(context, left, bottom);
  cairo_line_to(context, frame.x.end, bottom);
  cairo_stroke(context);

  auto tick = [&](double x, double y, double dx, double dy) { stroke_line(context, x, y, x + dx, y + dy); };
  const double line = bottom + tick_length + tick_gap + 0.8 * tick_style.size;
  for (std::size_t i = 0; i < across.major.size(); ++i) {
    set_pen(context, ink, axis_width);
    tick(frame.x(across.major[i]), bottom, 0, tick_length);
    draw_text(context, across.labels[i], frame.x(across.major[i]), line, tick_style, Align::centre);
  }
  double number_width = 0;
  for (std::size_t i = 0; i < up.major.size(); ++i) {
    set_pen(context, ink, axis_width);
    tick(left, frame.y(up.major[i]), -tick_length, 0);
    draw_text(context, up.labels[i], left - tick_length - tick_gap, frame.y(up.major[i]) + 0.36 * tick_style.size,
              tick_style, Align::right);
    number_width = std::max(number_width, text_extent(context, up.labels[i], tick_style).width);
  }
  draw_text(context, up.factor, left - tick_length - tick_gap, frame.y.end - 1.0 * tick_style.size, tick_style);
  const double title_line = line + 0.2 * tick_style.size + title_gap + label_style.size;
  draw_text(context, across.factor, frame.x.end, title_line, tick_style, Align::right);
  draw_text(context, frame.x_title, 0.5 * (left + frame.x.end), title_line, label_style, Align::centre);
  draw_text(context, frame.y_title, left - tick_length - tick_gap - number_width - title_gap - 0.3 * label_style.size,
            0.5 * (bottom + frame.y.end), label_style, Align::centre, 0.5 * std::numbers::pi);
}

double colour_bar_width(cairo_t* context, const ColourBar& bar, double height) {
  const Ticks ticks = ticks_for({bar.low, bar.high, height, 0}, 28);
  const double title = bar.title.empty() ? 0 : title_gap + 1.35 * label_style.size;
  return bar_distance + bar_width + tick_length + tick_gap + widest(context, ticks) + title;
}

void draw_colour_bar(cairo_t* context, const ColourBar& bar, const Rectangle& plot) {
  const double height = std::min(plot.height, 170.0);
  const Rectangle box{plot.right() + bar_distance, plot.y + 0.5 * (plot.height - height), bar_width, height};
  cairo_pattern_t* pattern = cairo_pattern_create_linear(0, box.bottom(), 0, box.y);
  constexpr int stops = 64;
  for (int i = 0; i <= stops; ++i) {
    const double t = static_cast<double>(i) / stops;
    const Colour colour = colour_at(t);
    cairo_pattern_add_color_stop_rgb(pattern, t, colour.red, colour.green, colour.blue);
  }
  cairo_rectangle(context, box.x, box.y, box.width, box.height);
  cairo_set_source(context, pattern);
  cairo_fill_preserve(context);
  cairo_pattern_destroy(pattern);
  set_pen(context, ink, 0.6);
  cairo_stroke(context);

  const Scale scale{bar.low, bar.high, box.bottom(), box.y};
  const Ticks ticks = ticks_for(scale, 28);
  double number_width = 0;
  for (std::size_t i = 0; i < ticks.major.size(); ++i) {
    const double y = scale(ticks.major[i]);
    set_pen(context, ink, 0.6);
    stroke_line(context, box.right(), y, box.right() + tick_length, y);
    draw_text(context, ticks.labels[i], box.right() + tick_length + tick_gap, y + 0.36 * tick_style.size, tick_style);
    number_width = std::max(number_width, text_extent(context, ticks.labels[i], tick_style).width);
  }
  draw_text(context, ticks.factor, box.x, box.y - 0.5 * tick_style.size, tick_style);
  draw_text(context, bar.title, box.right() + tick_length + tick_gap + number_width + title_gap + label_style.size,
            box.y + 0.5 * height, label_style, Align::centre, 0.5 * std::numbers::pi);
}

Margins arrow_key_margins(cairo_t* context, const ArrowKey& key) {
  return {0, bar_distance + key.length + key_gap + text_extent(context, key.label, legend_style).width, 0,
          1.6 * legend_style.size};
}

void draw_arrow_key(cairo_t* context, const ArrowKey& key, const Rectangle& plot, double below) {
  const double x = plot.right() + bar_distance, line = plot.bottom() + below - 0.3 * legend_style.size;
  const double y = line - 0.36 * legend_style.size;
  set_pen(context, key.colour, 1.0);
  stroke_arrow(context, x, y, x + key.length, y, 4);
  draw_text(context, key.label, x + key.length + key_gap, line, legend_style);
}

namespace {
constexpr double clearance = 6;
}

Rectangle emptiest_place(const Rectangle& plot, double width, double height, const std::vector<Obstacle>& obstacles) {
  const double left = plot.x + clearance, right = plot.right() - clearance - width;
  const double top = plot.y + clearance, bottom = plot.bottom() - clearance - height;
  const double middle = plot.x + 0.5 * (plot.width - width), centre = plot.y + 0.5 * (plot.height - height);
  const std::array<std::pair<double, double>, 8> candidates = {{{right, top},
                                                                {left, top},
                                                                {right, bottom},
                                                                {left, bottom},
                                                                {middle, top},
                                                                {middle, bottom},
                                                                {right, centre},
                                                                {left, centre}}};
  Rectangle best{right, top, width, height};
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const auto& [x, y] : candidates) {
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

void block(const Rectangle& rectangle, std::vector<Obstacle>& obstacles) {
  // Dense enough that a box put on any part of it counts more of these than of the data elsewhere.
  for (double x = rectangle.x; x <= rectangle.right(); x += 2) {
    for (double y = rectangle.y; y <= rectangle.bottom(); y += 2) obstacles.push_back({x, y});
  }
}

namespace {

void check(double low, double high, int most) {
  if (!(low < high) || !std::isfinite(high - low) || most < 1) {
    throw std::invalid_argument(fmt::format("no ticks from {} to {}, at most {}", low, high, most));
  }
}

int decade(double value) {
  return static_cast<int>(std::floor(std::log10(value) + 1e-12));
}

/// digit times 10 to the n; the nearest double to that as long as the power is exact.
double scaled(double digit, int n) {
  return n >= 0 ? digit * std::pow(10.0, n) : digit / std::pow(10.0, -n);
}

}  // namespace

std::string with_minus(std::string_view number) {
  return number.starts_with('-') ? "−" + std::string(number.substr(1)) : std::string(number);
}

double nice_step(double range, int most) {
  check(0, range, most);
  const int exponent = decade(range / most);
  for (const double digit : {1.0, 2.0, 5.0}) {
    // The tolerance keeps a range of 0.3 at 3 steps from needing 0.30000000000000004 / 0.1 = 4 of them.
    const double step = scaled(digit, exponent);
    if (range <= step * most * (1 + 1e-9)) return step;
  }
  return scaled(1, exponent + 1);
}

double nice_length(double most) {
  check(0, most, 1);
  const int exponent = decade(most);
  for (const double digit : {5.0, 2.0}) {
    if (scaled(digit, exponent) <= most * (1 + 1e-9)) return scaled(digit, exponent);
  }
  return scaled(1, exponent);
}

Ticks linear_ticks(double low, double high, int most) {
  check(low, high, most);
  const double step = nice_step(high - low, most);
  const double slack = 1e-9 * (high - low) / step;
  const double first = std::ceil(low / step - slack), last = std::floor(high / step + slack);
  Ticks ticks;
  for (double k = first; k <= last; k += 1) ticks.major.push_back(std::clamp(k * step, low, high));

  const double largest = std::max(std::abs(first), std::abs(last)) * step;
  const int exponent = largest > 0 ? decade(largest) : 0;
  const int factor = exponent >= 5 || exponent <= -3 ? exponent : 0;
  if (factor != 0) ticks.factor = fmt::format("×10^{{{}}}", factor);
  const int decimals = std::max(0, factor - decade(step));
  for (double k = first; k <= last; k += 1) {
    // k == 0 may be a negative zero
    ticks.labels.push_back(with_minus(fmt::format("{:.{}f}", k == 0 ? 0.0 : k * step / scaled(1, factor), decimals)));
  }
  return ticks;
}

}  // namespace talus::figure
