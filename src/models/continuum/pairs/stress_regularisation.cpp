// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/stress_regularisation.hpp"

#include <cmath>

#include "models/continuum/material.hpp"

namespace talus::continuum {

void regularise_stress(ThreadTeam& team, const Parameters& p, double dt, const Rates& rates, State& s) {
  const double per_strain = stress_regularisation(p) * p.law.of<granular::CriticalState>().shear_modulus * dt;
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
