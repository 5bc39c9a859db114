// SPDX-License-Identifier: Apache-2.0
/// Which part of space a particle picture shows.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/figure/figure.hpp"

namespace talus::figure {

namespace {

bool has_size(const Window& window) {
  return window.left < window.right && window.bottom < window.top && std::isfinite(window.right - window.left) &&
         std::isfinite(window.top - window.bottom);
}

}  // namespace

void check(const ParticlePicture& picture) {
  const std::size_t count = picture.positions.size();
  auto same = [&](const char* what, std::size_t length) {
    if (length != count) {
      throw std::invalid_argument(fmt::format("a picture of {} particles with {} {}", count, length, what));
    }
  };
  same("radii", picture.radii.size());
  auto positive = [](const char* what, double unit) {
    if (!(unit > 0)) throw std::invalid_argument(fmt::format("a picture with {} in units of {}", what, unit));
  };
  positive("lengths", picture.length.value);
  if (const auto* by_value = std::get_if<ByValue>(&picture.colouring)) {
    same("values", by_value->values.size());
    positive("values", by_value->unit.value);
    if (by_value->low && by_value->high && !(*by_value->low < *by_value->high)) {
      throw std::invalid_argument(fmt::format("colours from {} to {}", *by_value->low, *by_value->high));
    }
  }
  if (picture.arrows) {
    if (const std::size_t starts = picture.arrows->positions.size(); starts == 0)
      same("arrows", picture.arrows->values.size());
    else if (starts != picture.arrows->values.size())
      throw std::invalid_argument(fmt::format("{} arrows at {} positions", picture.arrows->values.size(), starts));
    positive("arrows", picture.arrows->unit.value);
  }
  if (picture.aspect && !(*picture.aspect > 0)) throw std::invalid_argument("a picture without height");
  if (picture.window && !has_size(*picture.window)) throw std::invalid_argument("a picture's window without extent");
}

std::optional<Ground> ground_of(const ParticlePicture& picture) {
  const double steepness = std::abs(picture.view.toward.z);
  if (!picture.slope || steepness < 1e-9 || steepness > 1 - 1e-9) return {};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Ground g{infinity, -infinity, infinity, -infinity};
  for (const Vector3& position : picture.positions) {
    if (!std::isfinite(position.x + position.y + position.z)) continue;
    g.x0 = std::min(g.x0, position.x), g.x1 = std::max(g.x1, position.x);
    g.y0 = std::min(g.y0, position.y), g.y1 = std::max(g.y1, position.y);
  }
  const double size = std::max(g.x1 - g.x0, g.y1 - g.y0);
  if (!(size > 0) || !std::isfinite(size)) return {};
  g.step = nice_length(size / 5);
  constexpr double room = 0.3;  // steps, at least
  g.x0 = g.step * std::floor(g.x0 / g.step - room), g.x1 = g.step * std::ceil(g.x1 / g.step + room);
  g.y0 = g.step * std::floor(g.y0 / g.step - room), g.y1 = g.step * std::ceil(g.y1 / g.step + room);
  return g;
}

Window window_of(const ParticlePicture& picture) {
  check(picture);
  if (picture.window) return *picture.window;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Window w{infinity, -infinity, infinity, -infinity};
  for (std::size_t i = 0; i < picture.positions.size(); ++i) {
    const double u = dot(picture.view.right, picture.positions[i]), v = dot(picture.view.up, picture.positions[i]);
    const double r = picture.radii[i];
    if (!std::isfinite(u + v + r)) continue;
    w.left = std::min(w.left, u - r), w.right = std::max(w.right, u + r);
    w.bottom = std::min(w.bottom, v - r), w.top = std::max(w.top, v + r);
  }
  if (!has_size(w)) return {};
  if (const auto ground = ground_of(picture)) {
    for (const Vector3& corner : {Vector3{ground->x0, ground->y0, 0}, Vector3{ground->x0, ground->y1, 0},
                                  Vector3{ground->x1, ground->y0, 0}, Vector3{ground->x1, ground->y1, 0}}) {
      const double u = dot(picture.view.right, corner), v = dot(picture.view.up, corner);
      w = {std::min(w.left, u), std::max(w.right, u), std::min(w.bottom, v), std::max(w.top, v)};
    }
  }
  const double room = 0.03 * std::max(w.right - w.left, w.top - w.bottom);
  return {w.left - room, w.right + room, w.bottom - room, w.top + room};
}

void share_scale(std::span<ParticlePicture> pictures) {
  double width = 0, height = 0;
  for (const ParticlePicture& picture : pictures) {
    const Window w = window_of(picture);
    width = std::max(width, w.right - w.left), height = std::max(height, w.top - w.bottom);
  }
  for (ParticlePicture& picture : pictures) {
    const Window w = window_of(picture);
    const double left = 0.5 * (w.left + w.right) - 0.5 * width;
    const double bottom = picture.slope ? w.bottom : 0.5 * (w.bottom + w.top) - 0.5 * height;
    picture.window = Window{left, left + width, bottom, bottom + height};
  }
}

double aspect_of(const ParticlePicture& picture) {
  if (picture.aspect) return *picture.aspect;
  const Window w = window_of(picture);
  return std::clamp((w.top - w.bottom) / (w.right - w.left), 0.2, 1.3);
}

}  // namespace talus::figure
