// SPDX-License-Identifier: Apache-2.0
/// tau/rho^2 of a particle, in the form of Eq. 17 that the case takes.
#pragma once

#include "models/continuum/material.hpp"
#include "models/continuum/pairs/pair_sums.hpp"
#include "physics/sph/balance.hpp"

namespace talus::continuum {

/// m^5/(kg s^2). Within the loop over the particles: what a call returns by memory, in halves of what is then read, is
/// waited for. \param grain_density kg/m^3
[[gnu::always_inline]] inline SymmetricTensor3<> specific_stress(const ParticleView& particles, std::size_t i,
                                                                 sph::StressForm form, double grain_density) {
  const double density = particles.density[i];
  const double packing = form == sph::StressForm::printed ? density / grain_density : 1;  // else unused
  return sph::specific_stress(stress_of(particles.material, i), density, packing, form);
}

}  // namespace talus::continuum
