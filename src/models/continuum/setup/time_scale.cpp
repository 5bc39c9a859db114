// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/time_scale.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

TimeScales time_scales_of(const Parameters& p) {
  const double bed = depth_of_grains(p);
  const double length = outlet_width_of(p).value_or(bed);
  const double g = p.gravity.acceleration > 0 ? p.gravity.acceleration : standard_gravity;
  const double time = std::sqrt(length / g);
  return {.length = length,
          .time = time,
          .settled_speed = p.settle.speed.value_or(share_of_speed * std::sqrt(length * g)),
          .settled_duration = p.settle.duration.value_or(share_of_time * time),
          .settling_limit =
              p.settle.max_time.value_or(end_of_filling(p) + share_of_limit * std::sqrt(std::max(length, bed) / g)),
          .averaging_time = p.analysis.averaging_time.value_or(share_of_time * time)};
}

double loading_time(const Parameters& p, double depth, const TimeScales& scales, double sound_speed) {
  constexpr double most = 0.25;
  const double passages = p.settle.filling == Filling::layers ? 80 : 20;
  if (p.gate.opens != GateOpens::when_settled) return 0;
  return p.settle.loading_time.value_or(std::min(passages * depth / sound_speed, most * scales.settling_limit));
}

double Loading::share(double time, double height) const {
  constexpr double layer = 0.1;  // of the loading time, in which a height gets its weight
  if (!(time < time_)) return 1.0;
  double passed = time, all = time_;
  if (filling_ == Filling::layers) {
    all = layer * time_;
    passed = time - std::clamp((height - bottom_) / depth_, 0.0, 1.0) * (time_ - all);
    if (!(passed < all)) return 1.0;
    passed = std::max(passed, 0.0);
  }
  return 0.5 * (1 - std::cos(std::numbers::pi * passed / all));
}

}  // namespace talus::continuum
