// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "io/figure/particle_layers.hpp"

namespace talus::figure {

namespace {

constexpr double min_radius = 0.35, outlined_from = 1.5, outline_width = 0.3;  // units
constexpr double palest = 0.5;  // share of white in the farthest particle

/// The colour of each particle.
std::vector<Colour> colours_of(const ParticlePicture& picture) {
  std::vector<Colour> colours(picture.positions.size(), pale);
  if (const auto* plain = std::get_if<Plain>(&picture.colouring)) {
    std::fill(colours.begin(), colours.end(), plain->colour);
  } else if (const auto* by_value = std::get_if<ByValue>(&picture.colouring)) {
    const ColourBar bar = bar_of(*by_value);
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const double value = by_value->values[i] / by_value->unit.value;
      if (std::isfinite(value)) colours[i] = colour_at((value - bar.low) / (bar.high - bar.low));
    }
  }
  return colours;
}

/// The order in which the discs are laid on each other: nearer ones on farther ones, in a section smaller ones on
/// larger ones.
std::vector<std::size_t> order_of(const ParticlePicture& picture) {
  std::vector<std::size_t> order(picture.positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> above(order.size());
  for (std::size_t i = 0; i < above.size(); ++i) {
    above[i] = picture.depth ? dot(picture.view.toward, picture.positions[i]) : -picture.radii[i];
    if (!std::isfinite(above[i])) above[i] = 0;  // not drawn; a NaN would leave no order
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return above[a] < above[b]; });
  return order;
}

void fade_with_depth(const ParticlePicture& picture, std::vector<Colour>& colours) {
  double nearest = -std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Vector3& position : picture.positions) {
    const double depth = dot(picture.view.toward, position);
    if (std::isfinite(depth)) nearest = std::max(nearest, depth), farthest = std::min(farthest, depth);
  }
  if (!(farthest < nearest)) return;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double depth = dot(picture.view.toward, picture.positions[i]);
    if (std::isfinite(depth)) colours[i] = mix(colours[i], white, palest * (nearest - depth) / (nearest - farthest));
  }
}

}  // namespace

namespace {

double mean_radius(const ParticlePicture& picture) {
  double sum = 0, count = 0;
  for (const double radius : picture.radii)
    if (std::isfinite(radius)) sum += radius, ++count;
  return count > 0 ? sum / count : 0;
}

}  // namespace

ColourBar bar_of(const ByValue& colouring) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : colouring.values) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  if (!(low <= high)) low = 0, high = colouring.unit.value;
  low /= colouring.unit.value, high /= colouring.unit.value;
  low = colouring.low.value_or(low), high = colouring.high.value_or(high);
  if (!(low < high)) low -= 0.5, high = low + 1;
  return {low, high, axis_title(colouring.label, colouring.unit.name)};
}

namespace {

/// The centre of each disc that the plot shows, with its radius, in the order in which they are laid on each other.
template <class Visit>
void for_each_seen(const ParticlePicture& picture, const Projection& p, const std::vector<std::size_t>& order,
                   Visit&& visit) {
  for (const std::size_t i : order) {
    const Obstacle centre = p(picture.positions[i]);
    const double radius = std::max(min_radius, picture.radii[i] * p.scale);
    if (!std::isfinite(centre.x + centre.y + picture.radii[i])) continue;
    const Rectangle reach{p.plot.x - radius, p.plot.y - radius, p.plot.width + 2 * radius, p.plot.height + 2 * radius};
    if (reach.contains(centre.x, centre.y)) visit(i, centre, radius);
  }
}

/// Many dots that are all as small as a disc can be, in one colour.
bool are_dots(const ParticlePicture& picture, const Projection& p) {
  constexpr std::size_t many = 50'000;
  return picture.positions.size() >= many && !picture.depth && std::holds_alternative<Plain>(picture.colouring) &&
         std::all_of(picture.radii.begin(), picture.radii.end(),
                     [&](double radius) { return radius * p.scale <= min_radius; });
}

}  // namespace

void draw_discs(cairo_t* context, const ParticlePicture& picture, const Projection& p,
                std::vector<Obstacle>& obstacles) {
  if (are_dots(picture, p)) {
    Stipple dots(context, min_radius, std::get<Plain>(picture.colouring).colour);
    for_each_seen(picture, p, order_of(picture), [&](std::size_t, const Obstacle& centre, double) {
      dots.add(centre.x, centre.y);
      obstacles.push_back(centre);
    });
    return dots.draw();
  }
  std::vector<Colour> colours = colours_of(picture);
  if (picture.depth) fade_with_depth(picture, colours);
  cairo_set_line_width(context, outline_width);
  const bool outlined = mean_radius(picture) * p.scale >= outlined_from;  // all or none
  for_each_seen(picture, p, order_of(picture), [&](std::size_t i, const Obstacle& centre, double radius) {
    cairo_new_sub_path(context);
    cairo_arc(context, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
    set_colour(context, colours[i]);
    if (!outlined) {
      cairo_fill(context);
    } else {
      cairo_fill_preserve(context);
      set_colour(context, mix(colours[i], ink, 0.45));
      cairo_stroke(context);
    }
    if (picture.depth && outlined) {  // a highlight makes a ball of it
      cairo_arc(context, centre.x - 0.28 * radius, centre.y - 0.3 * radius, 0.42 * radius, 0, 2 * std::numbers::pi);
      set_colour(context, with_alpha(white, 0.28));
      cairo_fill(context);
    }
    obstacles.push_back(centre);
  });
}

}  // namespace talus::figure
