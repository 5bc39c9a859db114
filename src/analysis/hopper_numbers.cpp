// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/displacement.hpp"
#include "analysis/statistics.hpp"

namespace talus::hopper {

namespace {

constexpr double none = HopperRun::none;
constexpr double nearly_all = 0.999, most = 0.95;
constexpr double least_slope_in_spacings = 10;

std::vector<bool> without_nan(std::vector<bool> taken, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) taken[i] = taken[i] && !std::isnan(values[i]);
  return taken;
}

}  // namespace

double mass(const HopperSnapshot& s) {
  return static_cast<double>(s.now.size()) * s.setting.particle_mass;
}

const FreeSurface& surface_in(const HopperSnapshot& s, Where where) {
  return where == Where::bin ? s.surfaces().bin : s.surfaces().hopper;
}

ReposeAngle repose_in(const HopperSnapshot& s, Where where) {
  const double least = least_slope_in_spacings * s.shape().spacing;
  return repose_angle(heap_slopes(surface_in(s, where), least), s.shape().middle());
}

double quiescent_speed(const HopperSnapshot& s) {
  const Snapshot* before = s.before ? s.before() : nullptr;
  if (!before) return none;
  const std::vector<double> speed = mean_speeds(*before, s.now);
  return quantile_of(speed, without_nan(s.deep(), speed), most);
}

double packing_max(const HopperSnapshot& s) {
  return quantile(s.now.scalars("packing"), nearly_all);
}

double density_drift(const HopperSnapshot& s) {
  return talus::density_drift(s.now.scalars("density"), s.now.scalars("packing"), s.setting.grain_density, s.deep());
}

double stress_ratio(const HopperSnapshot& s) {
  return talus::stress_ratio(s.now, quasistatic_particles(s.now, s.inertial()));
}

double inertial_share(const HopperSnapshot& s) {
  return talus::inertial_share(s.inertial(), above_outlet(s.now.positions(), s.shape()));
}

double left_right_imbalance(const HopperSnapshot& s) {
  double difference = 0;
  for (const Vector3& x : s.now.positions())
    if (x.z < s.shape().bin().top) difference += x.x < s.shape().middle() ? -1 : 1;
  return std::abs(difference) / s.setting.particles;
}

}  // namespace talus::hopper
