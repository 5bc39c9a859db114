// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/time_scale.hpp"

#include <algorithm>
#include <cmath>

#include "models/continuum/boundary/vessel_outlets.hpp"
#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {

namespace {

constexpr double standard_gravity = 9.80665;
constexpr double share_of_speed = 8e-4, share_of_time = 0.3, share_of_limit = 15;

/// Until when inlets fill the vessel before the gate opens, s.
double end_of_filling(const Parameters& p) {
  double end = 0;
  for (const Inlet& inlet : p.inlets)
    if (inlet.clock == InletClock::start && inlet.to) end = std::max(end, *inlet.to);
  return end;
}

}  // namespace

std::optional<double> outlet_width(const Parameters& p) {
  const auto outlet = outlet_of(p);
  if (!outlet || !(outlet->right > outlet->left)) return std::nullopt;
  const bool halved = p.vessel.empty() && ((p.box.left == FaceKind::symmetry && outlet->left <= 0) ||
                                           (p.box.right == FaceKind::symmetry && outlet->right >= p.box.width));
  if (!halved) return outlet->across;
  return std::min(2 * (outlet->right - outlet->left), distance_of_walls(p.box.front, p.box.rear, p.box.depth));
}

TimeScales time_scales_of(const Parameters& p) {
  const double bed = depth_of_grains(p);
  const double length = outlet_width(p).value_or(bed);
  const double g = p.gravity.acceleration > 0 ? p.gravity.acceleration : standard_gravity;
  const double time = std::sqrt(length / g);
  return {.length = length,
          .time = time,
          .settled_speed = p.settle.speed.value_or(share_of_speed * std::sqrt(length * g)),
          .settled_duration = p.settle.duration.value_or(share_of_time * time),
          .settling_limit =
              p.settle.longest.value_or(end_of_filling(p) + share_of_limit * std::sqrt(std::max(length, bed) / g)),
          .averaging_time = p.analysis.averaging_time.value_or(share_of_time * time)};
}

}  // namespace talus::continuum
