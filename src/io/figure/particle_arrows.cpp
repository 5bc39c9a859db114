// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "io/figure/particle_layers.hpp"

namespace talus::figure {

namespace {

constexpr double usual_arrow = 16, arrow_width = 0.7, arrow_head = 4, longest_key = 18;  // units

/// The magnitude that all but the largest twentieth stay below.
double usual_magnitude(std::span<const Vector3> values) {
  std::vector<double> magnitudes;
  for (const Vector3& value : values) {
    if (std::isfinite(norm(value))) magnitudes.push_back(norm(value));
  }
  if (magnitudes.empty()) return 0;
  const auto place =
      magnitudes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(magnitudes.size() - 1));
  std::nth_element(magnitudes.begin(), place, magnitudes.end());
  return *place;
}

}  // namespace

std::optional<LegendEntry> draw_arrows(cairo_t* context, const ParticlePicture& picture, const Projection& p,
                                       std::vector<Obstacle>& obstacles) {
  const Arrows& arrows = *picture.arrows;
  double per_unit = arrows.length;
  if (per_unit == 0) {
    const double usual = usual_magnitude(arrows.values) / arrows.unit.value;
    if (!(usual > 0)) return {};
    per_unit = usual_arrow / usual;
  }
  const double scale = per_unit / arrows.unit.value;
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
  if (!arrows.key) return {};
  const double key = nice_length(longest_key / per_unit);
  return LegendEntry{fmt::format("{:g} {}", key, arrows.unit.name),
                     [colour = arrows.colour, length = key * per_unit](cairo_t* pen, const Rectangle& box) {
                       const double y = box.y + 0.5 * box.height;
                       set_pen(pen, colour, 1.0);
                       stroke_arrow(pen, box.x, y, box.x + length, y, arrow_head);
                     }};
}

}  // namespace talus::figure
