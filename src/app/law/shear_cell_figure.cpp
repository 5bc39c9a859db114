// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/law/shear_cell_results.hpp"
#include "io/figure/axes.hpp"
#include "io/figure/canvas.hpp"
#include "io/file.hpp"

namespace talus::app {

namespace {

using figure::Frame;

constexpr double side = 300, gap = 70, edge = 12, line = 1.2, thin = 0.7, dot = 2.6;  // units of the page

void mark(cairo_t* context, const Frame& frame, const granular::YieldPoint& point, const figure::Colour& colour,
          bool filled) {
  if (!std::isfinite(point.shear)) return;
  cairo_new_path(context);
  cairo_arc(context, frame.x(point.normal / 1e3), frame.y(point.shear / 1e3), dot, 0, 2 * std::numbers::pi);
  figure::set_colour(context, filled ? colour : figure::white);
  cairo_fill_preserve(context);
  figure::set_pen(context, colour, line);
  cairo_stroke(context);
}

/// The upper half of the circle between two principal stresses, Pa. Both axes have the same scale.
void draw_circle(cairo_t* context, const Frame& frame, double minor, double major, const figure::Colour& colour) {
  cairo_new_path(context);
  cairo_arc(context, frame.x(0.5 * (minor + major) / 1e3), frame.y(0),
            frame.x(major / 1e3) - frame.x(0.5 * (minor + major) / 1e3), std::numbers::pi, 2 * std::numbers::pi);
  figure::set_pen(context, colour, thin);
  cairo_stroke(context);
}

void draw_loci(cairo_t* context, const Frame& frame, std::span<const granular::ShearTest> tests) {
  for (std::size_t n = 0; n < tests.size(); ++n) {
    const granular::ShearTest& test = tests[n];
    const granular::YieldLocus& locus = test.locus;
    const figure::Colour colour = figure::palette_colour(n);
    const double sine = std::sin(locus.angle), apex = locus.cohesion / std::tan(locus.angle);
    if (locus.strength > 0) draw_circle(context, frame, 0, locus.strength, colour);
    draw_circle(context, frame, (locus.major + apex) * (1 - sine) / (1 + sine) - apex, locus.major, colour);
    const double end = 1.1 * test.pre_shear.normal;
    figure::set_pen(context, colour, line);
    figure::stroke_line(context, frame.x(0), frame.y(locus.cohesion / 1e3), frame.x(end / 1e3),
                        frame.y((locus.cohesion + end * std::tan(locus.angle)) / 1e3));
    figure::set_pen(context, colour, thin);
    for (std::size_t k = 1; k < test.on_wall.size(); ++k) {
      const granular::YieldPoint &from = test.on_wall[k - 1], &to = test.on_wall[k];
      figure::stroke_line(context, frame.x(from.normal / 1e3), frame.y(from.shear / 1e3), frame.x(to.normal / 1e3),
                          frame.y(to.shear / 1e3));
    }
    for (const granular::YieldPoint& point : test.points) mark(context, frame, point, colour, false);
    mark(context, frame, test.pre_shear, colour, true);
  }
  if (tests.empty() || tests.back().on_wall.empty()) return;
  const granular::YieldPoint& end = tests.back().on_wall.back();
  figure::draw_text(context, "wall", frame.x(end.normal / 1e3) + 5, frame.y(end.shear / 1e3) + 3,
                    {.size = 8.5, .colour = figure::muted});
}

void draw_flow_function(cairo_t* context, const Frame& frame, std::span<const granular::ShearTest> tests) {
  for (const double factor : {1.0, 2.0, 4.0, 10.0}) {
    const double x = std::min(frame.x.high, factor * frame.y.high);
    figure::set_pen(context, figure::pale, thin);
    figure::stroke_line(context, frame.x(0), frame.y(0), frame.x(x), frame.y(x / factor));
    figure::draw_text(context, fmt::format("*ff*_{{c}} = {:g}", factor), frame.x(x) - 3, frame.y(x / factor) - 4,
                      {.size = 8.5, .colour = figure::muted}, figure::Align::right);
  }
  const auto draw = [&](double granular::ShearTest::*strength, const figure::Colour& colour, bool filled) {
    for (const granular::ShearTest& test : tests)
      mark(context, frame, {test.locus.major, test.*strength}, colour, filled);
  };
  draw(&granular::ShearTest::strength_in_plane_strain, figure::vermillion, false);
  draw(&granular::ShearTest::strength_of_cylinder, figure::green, false);
  figure::set_pen(context, figure::blue, line);
  for (std::size_t n = 0; n < tests.size(); ++n) {
    const double x = frame.x(tests[n].locus.major / 1e3), y = frame.y(tests[n].locus.strength / 1e3);
    n == 0 ? cairo_move_to(context, x, y) : cairo_line_to(context, x, y);
  }
  cairo_stroke(context);
  for (const granular::ShearTest& test : tests)
    mark(context, frame, {test.locus.major, test.locus.strength}, figure::blue, true);
  double y = frame.y.end + 10;
  for (const auto& [text, colour] : {std::pair{"by the yield locus", figure::blue},
                                     {"compressed in plane strain", figure::vermillion},
                                     {"compressed cylinder", figure::green}}) {
    figure::draw_text(context, text, frame.x.begin + 8, y, {.size = 8.5, .colour = colour});
    y += 12;
  }
}

/// A number a little above, of which an axis has round parts.
double above(double value) {
  const double step = figure::nice_step(value, 5);
  return step * std::ceil(value / step + 0.02);
}

}  // namespace

void write_shear_figure(std::span<const granular::ShearTest> tests, const std::filesystem::path& file) {
  double major = 0, strength = 0;
  for (const granular::ShearTest& test : tests) {
    major = std::max(major, test.locus.major);
    for (const double one : {test.locus.strength, test.strength_in_plane_strain, test.strength_of_cylinder})
      strength = std::fmax(strength, one);
  }
  const double reach = above(major / 1e3);
  Frame loci{.x = {0, reach, 0, side},
             .y = {0, 0.6 * reach, 0, -0.6 * side},
             .x_title = "normal stress *σ* (kPa)",
             .y_title = "shear stress *τ* (kPa)"};
  Frame flow{.x = {0, reach, 0, side},
             .y = {0, above(std::max(strength / 1e3, 0.12 * reach)), 0, -0.6 * side},
             .x_title = "consolidation stress *σ*_{1} (kPa)",
             .y_title = "unconfined yield strength *f*_{c} (kPa)"};
  const figure::Canvas scratch(1, 1, 1);
  const figure::Margins around = frame_margins(scratch.context(), loci),
                        beside = frame_margins(scratch.context(), flow);
  const double top = edge + std::max(around.top, beside.top), bottom = std::max(around.bottom, beside.bottom);
  const double first = edge + around.left, second = first + side + gap + beside.left;
  figure::Canvas canvas(second + side + beside.right + edge, top + 0.6 * side + bottom + edge, 2);
  for (auto& [frame, left] : {std::pair<Frame&, double>{loci, first}, {flow, second}}) {
    frame.x.begin += left, frame.x.end += left;
    frame.y.begin += top + 0.6 * side, frame.y.end += top + 0.6 * side;
    draw_frame(canvas.context(), frame);
  }
  draw_loci(canvas.context(), loci, tests);
  draw_flow_function(canvas.context(), flow, tests);
  write_atomically(file, canvas.png());
}

}  // namespace talus::app
