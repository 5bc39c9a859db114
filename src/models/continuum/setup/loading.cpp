// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/loading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::continuum {

double loading_time(const Parameters& p, double depth, const TimeScales& scales, double sound_speed) {
  constexpr double passages = 20, most = 0.25;
  if (p.gate.opens != GateOpens::when_settled) return 0;
  return p.settle.loading_time.value_or(std::min(passages * depth / sound_speed, most * scales.settling_limit));
}

double share_of_gravity(double time, double loading_time) {
  return time < loading_time ? 0.5 * (1 - std::cos(std::numbers::pi * time / loading_time)) : 1.0;
}

}  // namespace talus::continuum
