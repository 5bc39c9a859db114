// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche_numbers.hpp"

#include <numbers>

#include "analysis/displacement.hpp"
#include "analysis/frontal_angle.hpp"

namespace talus::avalanche {

using View = AvalancheView;

double head_count(const AvalancheSnapshot& s, const Place&) {
  return s.view == View::from_above ? static_cast<double>(s.heads().size()) : AvalancheRun::none;
}

double head_particles(const AvalancheSnapshot& s, const Place&) {
  if (s.view != View::from_above) return AvalancheRun::none;
  return s.heads().empty() ? 0 : static_cast<double>(s.heads()[0].size());
}

double front_rear_thickness_ratio(const AvalancheSnapshot& s, const Place&) {
  if (s.view != View::from_the_side) return AvalancheRun::none;
  return s.profile().head_thickness() / s.profile().rear_thickness();
}

double frontal_angle(const AvalancheSnapshot& s, const Place&) {
  if (s.view != View::from_the_side) return AvalancheRun::none;
  const auto angle = angle_of_line(s.position(), surface_walk(s.position(), s.scales.mean_radius));
  return angle ? *angle * 180 / std::numbers::pi : AvalancheRun::none;
}

double displacement_spread(const AvalancheSnapshot& s, const Place&) {
  const DisplacementSpread spread = talus::displacement_spread(s.start, s.now.positions());
  return spread.along / spread.mean;
}

double displacement_lateral(const AvalancheSnapshot& s, const Place&) {
  return talus::displacement_spread(s.start, s.now.positions()).lateral / s.scales.mean_radius;
}

}  // namespace talus::avalanche
