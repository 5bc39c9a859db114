// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/stress_regularisation.hpp"

#include <cmath>
#include <type_traits>

#include "models/continuum/material.hpp"

namespace talus::continuum {

namespace {

/// Of a law that keeps its deviator as a stress, Pa.
double shear_modulus(const Parameters& p) {
  return granular::with_chosen_law(p.law, []<class Law>(const auto& law) {
    if constexpr (std::is_same_v<Law, granular::CriticalState>) return law.shear_modulus;
    return 0.0;
  });
}

}  // namespace

double stress_regularisation(const Parameters& p) {
  return shear_modulus(p) > 0 ? p.sph.stress_regularisation : 0;
}

void regularise_stress(ThreadTeam& team, const Parameters& p, double dt, const Rates& rates, State& s) {
  const double per_strain = p.sph.stress_regularisation * shear_modulus(p) * dt;
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
