// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/stress_regularisation.hpp"

#include <algorithm>
#include <cmath>

#include "models/continuum/material.hpp"

namespace talus::continuum {

namespace {

/// Of grains that stick together: |s| goes with p + a, and the mean of the neighbours, tension among them, is one over
/// the kernel's sum.
void regularise_cohesive(ThreadTeam& team, double mass, double per_strain, double strength_at_start, const Rates& rates,
                         State& s) {
  const std::vector<double>& strengthening = s.material.history.back();
  for_each(team, s.position.size(), [&](std::size_t i) {
    const double strength = strength_at_start + strengthening[i];
    const SymmetricTensor3<> stress = tensor_at(s.material.stress, i);
    const SymmetricTensor3<> mean =
        (mass * s.density[i] * s.density[i] / rates.kernel_density[i]) * tensor_at(rates.stress_around, i);
    const double bearing = trace(stress) / 3 + strength, bearing_around = trace(mean) / 3 + strength;
    if (!(bearing > 0 && bearing_around > 0)) return;
    const SymmetricTensor3<> rate = deviator(symmetric_part(rates.velocity_gradient[i]));
    const double q = per_strain * std::sqrt(2 * double_dot(rate, rate)) / bearing;
    // Stronger neighbours may bear more than the ratio of a weak particle stands for.
    const double ratio = std::min(bearing / bearing_around, 2.0);
    const SymmetricTensor3<> missing = ratio * deviator(mean) - deviator(stress);
    set_tensor(s.material.stress, i, stress + (q / (1 + q)) * missing);
  });
}

}  // namespace

void regularise_stress(ThreadTeam& team, const Parameters& p, double dt, const Rates& rates, State& s) {
  const auto& law = p.law.of<granular::CriticalState>();
  const double per_strain = stress_regularisation(p) * law.shear_modulus * dt;
  if (law.has_cohesion()) return regularise_cohesive(team, s.mass, per_strain, law.strength_at_start(), rates, s);
  for_each(team, s.position.size(), [&](std::size_t i) {
    const SymmetricTensor3<> stress = tensor_at(s.material.stress, i), around = tensor_at(rates.stress_around, i);
    const double pressure = trace(stress) / 3, pressure_around = trace(around) / 3;
    if (!(pressure > 0 && pressure_around > 0)) return;
    const SymmetricTensor3<> rate = deviator(symmetric_part(rates.velocity_gradient[i]));
    const double q = per_strain * std::sqrt(2 * double_dot(rate, rate)) / pressure;
    const SymmetricTensor3<> missing = (pressure / pressure_around) * deviator(around) - deviator(stress);
    set_tensor(s.material.stress, i, stress + (q / (1 + q)) * missing);
  });
}

}  // namespace talus::continuum
