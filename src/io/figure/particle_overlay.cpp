// SPDX-License-Identifier: Apache-2.0
/// What explains the particles: the slope they are on, walls, the scale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/figure/particle_layers.hpp"

namespace talus::figure {

namespace {

constexpr Colour earth = rgb(0xeceef1), grid_line = rgb(0x9aa3ad), shadow = rgb(0xb4bac2);
constexpr double slope_width = 1.4;  // units

/// The slope is a line: through the projected origin, along the projected x or y axis.
void draw_line(cairo_t* context, const Projection& p) {
  const Obstacle origin = p({});
  const Vector3 along = std::abs(p.view.right.x) > std::abs(p.view.right.y) ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  const double dx = dot(p.view.right, along), dy = -dot(p.view.up, along);
  const double middle_x = p.plot.x + 0.5 * p.plot.width, middle_y = p.plot.y + 0.5 * p.plot.height;
  const double t = (middle_x - origin.x) * dx + (middle_y - origin.y) * dy;
  const double foot_x = origin.x + t * dx, foot_y = origin.y + t * dy, far = p.plot.width + p.plot.height;
  const double nx = -dot(p.view.right, {0, 0, 1}), ny = dot(p.view.up, {0, 0, 1});  // into the ground
  cairo_move_to(context, foot_x - far * dx, foot_y - far * dy);
  cairo_line_to(context, foot_x + far * dx, foot_y + far * dy);
  cairo_line_to(context, foot_x + far * (dx + nx), foot_y + far * (dy + ny));
  cairo_line_to(context, foot_x - far * (dx - nx), foot_y - far * (dy - ny));
  set_colour(context, earth);
  cairo_fill(context);
  set_pen(context, ink, slope_width);
  stroke_line(context, foot_x - far * dx, foot_y - far * dy, foot_x + far * dx, foot_y + far * dy);
}

/// The slope is a plane.
void draw_plane(cairo_t* context, const ParticlePicture& picture, const Ground& ground, const Projection& p) {
  const auto [x0, x1, y0, y1, step] = ground;
  auto line_to = [&](double x, double y) {
    const Obstacle corner = p({x, y, 0});
    cairo_line_to(context, corner.x, corner.y);
  };
  line_to(x0, y0), line_to(x1, y0), line_to(x1, y1), line_to(x0, y1);
  cairo_close_path(context);
  set_colour(context, earth);
  cairo_fill(context);
  for (int k = 0; x0 + k * step < x1 + 0.5 * step; ++k) {
    cairo_new_sub_path(context);
    line_to(x0 + k * step, y0), line_to(x0 + k * step, y1);
  }
  for (int k = 0; y0 + k * step < y1 + 0.5 * step; ++k) {
    cairo_new_sub_path(context);
    line_to(x0, y0 + k * step), line_to(x1, y0 + k * step);
  }
  set_pen(context, with_alpha(grid_line, 0.45), 0.6);
  cairo_stroke(context);
  // All shadows in one path, so that they do not darken each other.
  for (std::size_t i = 0; i < picture.positions.size(); ++i) {
    const Vector3& position = picture.positions[i];
    const double radius = picture.radii[i] * p.scale;
    const Obstacle foot = p({position.x, position.y, 0});
    if (!std::isfinite(foot.x + foot.y + radius)) continue;
    const cairo_matrix_t flat{p.view.right.x, -p.view.up.x, p.view.right.y, -p.view.up.y, foot.x, foot.y};
    const Saved saved(context);
    cairo_transform(context, &flat);
    cairo_new_sub_path(context);
    cairo_arc(context, 0, 0, radius, 0, 2 * std::numbers::pi);
  }
  set_colour(context, shadow);
  cairo_fill(context);
}

}  // namespace

void draw_slope(cairo_t* context, const ParticlePicture& picture, const Projection& p) {
  if (!picture.slope) return;
  if (std::abs(p.view.toward.z) < 1e-9) {
    draw_line(context, p);
  } else if (const auto ground = ground_of(picture)) {
    draw_plane(context, picture, *ground, p);
  }
}

void draw_segments(cairo_t* context, const ParticlePicture& picture, const Projection& p,
                   std::vector<Obstacle>& obstacles) {
  for (const Segment& segment : picture.segments) {
    const Obstacle from = p(segment.from), to = p(segment.to);
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!std::isfinite(length) || length == 0) continue;
    set_pen(context, segment.colour, 1.2);
    stroke_line(context, from.x, from.y, to.x, to.y);
    for (double t = 0; t <= 1; t += 4 / std::max(length, 4.0)) {
      obstacles.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
  }
}

void draw_scale_bar(cairo_t* context, const ParticlePicture& picture, const Projection& p,
                    std::vector<Obstacle>& obstacles) {
  const double unit = picture.length.value;
  const double value = nice_length(0.28 * p.plot.width / p.scale / unit), length = value * unit * p.scale;
  const std::string label = fmt::format("{:g} {}", value, picture.length.name);
  const double text = text_extent(context, label, legend_style).width;
  const double width = std::max(length, text) + 8, height = 1.2 * legend_style.size + 9;
  const Rectangle box = emptiest_place(p.plot, width, height, obstacles);
  fill_rectangle(context, box, with_alpha(white, 0.85));
  const double middle = box.x + 0.5 * box.width, y = box.bottom() - 4;
  set_pen(context, ink, 1.8);
  stroke_line(context, middle - 0.5 * length, y, middle + 0.5 * length, y);
  draw_text(context, label, middle, y - 4.5, legend_style, Align::centre);
  block(box, obstacles);
}

}  // namespace talus::figure
