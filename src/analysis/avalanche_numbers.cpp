// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche_numbers.hpp"

#include <numbers>

#include "analysis/frontal_angle.hpp"

namespace talus::avalanche {

using View = AvalancheView;

double head_count(const AvalancheSnapshot& s) {
  return s.view == View::from_above ? static_cast<double>(s.heads().size()) : AvalancheRun::none;
}

double head_particles(const AvalancheSnapshot& s) {
  if (s.view != View::from_above) return AvalancheRun::none;
  return s.heads().empty() ? 0 : static_cast<double>(s.heads()[0].size());
}

double frontal_angle(const AvalancheSnapshot& s) {
  if (s.view != View::from_the_side) return AvalancheRun::none;
  const auto angle = angle_of_line(s.position(), surface_walk(s.position(), s.scales.mean_radius));
  return angle ? *angle * 180 / std::numbers::pi : AvalancheRun::none;
}

}  // namespace talus::avalanche
