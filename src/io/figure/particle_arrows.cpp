// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "io/figure/particle_layers.hpp"

namespace talus::figure {

namespace {

constexpr double usual_arrow = 16, arrow_width = 0.7, arrow_head = 4, max_key_length = 18;  // units

/// The magnitude that all but the largest twentieth stay below.
double usual_magnitude(std::span<const Vector3> values) {
  std::vector<double> magnitudes;
  for (const Vector3& value : values) {
    if (std::isfinite(norm(value))) magnitudes.push_back(norm(value));
  }
  if (magnitudes.empty()) return 0;
  const auto nth = magnitudes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(magnitudes.size() - 1));
  std::nth_element(magnitudes.begin(), nth, magnitudes.end());
  return *nth;
}

/// Units of the page for one `unit`; 0: there is no arrow.
double length_of_unit(const Arrows& arrows) {
  if (arrows.length != 0) return arrows.length;
  const double usual = usual_magnitude(arrows.values) / arrows.unit.value;
  return usual > 0 ? usual_arrow / usual : 0;
}

}  // namespace

void draw_arrows(cairo_t* context, const ParticlePicture& picture, const Projection& p,
                 std::vector<Obstacle>& obstacles) {
  const Arrows& arrows = *picture.arrows;
  const double scale = length_of_unit(arrows) / arrows.unit.value;
  if (scale == 0) return;
  const std::span<const Vector3> positions = arrows.positions.empty() ? picture.positions : arrows.positions;
  std::unordered_set<std::uint64_t> taken;
  set_pen(context, arrows.colour, arrow_width);
  for (std::size_t i = 0; i < arrows.values.size(); ++i) {
    const Obstacle from = p(positions[i]);
    const double dx = dot(p.view.right, arrows.values[i]) * scale, dy = -dot(p.view.up, arrows.values[i]) * scale;
    if (!std::isfinite(dx + dy) || !p.plot.contains(from.x, from.y)) continue;
    if (arrows.spacing > 0) {
      const auto column = static_cast<std::uint64_t>((from.x - p.plot.x) / arrows.spacing);
      const auto row = static_cast<std::uint64_t>((from.y - p.plot.y) / arrows.spacing);
      if (!taken.insert(row << 32 | column).second) continue;
    }
    stroke_arrow(context, from.x, from.y, from.x + dx, from.y + dy, arrow_head);
    for (const double t : {0.5, 1.0}) obstacles.push_back({from.x + t * dx, from.y + t * dy});
  }
}

std::optional<ArrowKey> key_of(const ParticlePicture& picture) {
  if (!picture.arrows || !picture.arrows->key) return std::nullopt;
  const Arrows& arrows = *picture.arrows;
  const double per_unit = length_of_unit(arrows);
  if (per_unit == 0) return std::nullopt;
  const double value = nice_length(max_key_length / per_unit);
  return ArrowKey{
      .label = fmt::format("{:g} {}", value, arrows.unit.name), .length = value * per_unit, .colour = arrows.colour};
}

}  // namespace talus::figure
