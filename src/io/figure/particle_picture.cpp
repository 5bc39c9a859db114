// SPDX-License-Identifier: Apache-2.0
#include "io/figure/figure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/figure/particle_layers.hpp"

namespace talus::figure {

namespace {

/// Widens the window to the shape of the plot; on a slope that is seen level, most of the new room is above.
Projection projection_of(const ParticlePicture& picture, const Rectangle& plot) {
  Window w = window_of(picture);
  const double scale = std::min(plot.width / (w.right - w.left), plot.height / (w.top - w.bottom));
  const double across = plot.width / scale - (w.right - w.left), along = plot.height / scale - (w.top - w.bottom);
  const double below = picture.slope && picture.view.up.z == 1 ? 0.15 : 0.5;
  w.left -= 0.5 * across, w.right += 0.5 * across;
  w.bottom -= below * along, w.top += (1 - below) * along;
  return {picture.view, w, plot, scale};
}

bool has_axes(const ParticlePicture& picture) {
  return picture.axes && axis_of(picture.view.right).name && axis_of(picture.view.up).name;
}

Frame frame_of(const ParticlePicture& picture, const Projection& p) {
  const AxisName across = axis_of(picture.view.right), up = axis_of(picture.view.up);
  const double unit = picture.length.value;
  Frame frame;
  frame.x = {across.sign * p.window.left / unit, across.sign * p.window.right / unit, p.plot.x, p.plot.right()};
  frame.y = {up.sign * p.window.bottom / unit, up.sign * p.window.top / unit, p.plot.bottom(), p.plot.y};
  frame.x_title = axis_title(fmt::format("*{}*", across.name), picture.length.name);
  frame.y_title = axis_title(fmt::format("*{}*", up.name), picture.length.name);
  return frame;
}

}  // namespace

Margins margins(cairo_t* context, const ParticlePicture& picture, const Rectangle& plot) {
  Margins around{2, 2, 4, 2};
  if (has_axes(picture)) around = frame_margins(context, frame_of(picture, projection_of(picture, plot)));
  const auto* by_value = std::get_if<ByValue>(&picture.colouring);
  const double bar = by_value && by_value->bar ? colour_bar_width(context, bar_of(*by_value), plot.height) : 0;
  Margins key;
  if (const auto arrow = key_of(picture)) key = arrow_key_margins(context, *arrow);
  around.right += std::max(bar, key.right);
  around.bottom = std::max(around.bottom, key.bottom);
  return around;
}

void draw(cairo_t* context, const ParticlePicture& picture, const Rectangle& plot) {
  const Projection projection = projection_of(picture, plot);
  std::vector<Obstacle> obstacles;
  {
    const Saved saved(context);
    cairo_rectangle(context, plot.x, plot.y, plot.width, plot.height);
    cairo_clip(context);
    draw_slope(context, picture, projection);
    draw_discs(context, picture, projection, obstacles);
    if (picture.arrows) draw_arrows(context, picture, projection, obstacles);
    draw_segments(context, picture, projection, obstacles);
  }
  if (has_axes(picture)) draw_frame(context, frame_of(picture, projection));
  if (picture.scale_bar && !has_axes(picture)) draw_scale_bar(context, picture, projection, obstacles);
  const auto* by_value = std::get_if<ByValue>(&picture.colouring);
  if (by_value && by_value->bar) draw_colour_bar(context, bar_of(*by_value), plot);
  // In a line with the name of the axis, where there is one: numbers of the axis may reach beyond the plot.
  if (const auto key = key_of(picture)) draw_arrow_key(context, *key, plot, margins(context, picture, plot).bottom);
}

}  // namespace talus::figure
