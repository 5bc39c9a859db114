// SPDX-License-Identifier: Apache-2.0
/// A bed of particles of several sizes.
#pragma once

#include "models/continuum/cases.hpp"
#include "models/continuum/setup/initial.hpp"

namespace talus::continuum {

/// 24 x 8 x 16 spacings between walls without friction: particles of bed.spacing in a corner, coarser ones beyond.
inline Parameters bed_of_levels(int levels) {
  Parameters p = column(24, 8, 16, 4);
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 2e5, law.shear_modulus = 1.2e5, law.reference_packing = 0.6;
  p.law = law;
  p.sph.smoothing = Smoothing::local;
  p.sph.viscosity_alpha = 0.1;
  p.integration.method = Method::leapfrog;
  p.integration.courant = default_courant(Method::leapfrog);
  p.levels.count = levels;
  p.levels.distance = 2 * spacing;
  p.levels.low = {0, 0, 0};
  p.levels.high = {8 * spacing, 8 * spacing, 8 * spacing};
  return p;
}

/// Masses, volumes and momenta of all particles.
struct Content {
  double mass_ratio = 0, volume = 0, energy = 0;
  Vector3 momentum, middle;

  explicit Content(const State& s) {
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      mass_ratio += s.mass_ratio[i];
      volume += s.mass_of(i) / s.density[i];
      energy += 0.5 * s.mass_of(i) * dot(s.velocity[i], s.velocity[i]);
      momentum += s.mass_of(i) * s.velocity[i];
      middle += s.mass_of(i) * s.position[i];
    }
  }
};

}  // namespace talus::continuum
