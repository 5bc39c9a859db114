// SPDX-License-Identifier: Apache-2.0
/// A bed of particles of several sizes.
#pragma once

#include <numbers>

#include "models/continuum/setup/initial.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {

/// The law and the settings that levels need.
inline void make_divisible(Parameters& p) {
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 2e5, law.shear_modulus = 1.2e5, law.reference_packing = 0.6;
  p.law = law;
  p.sph.smoothing = Smoothing::local;
  p.sph.viscosity_alpha = 0.1;
  p.integration.method = Method::leapfrog;
  p.integration.courant = default_courant(Method::leapfrog);
}

/// 24 x 8 x 16 spacings between walls without friction: particles of bed.spacing in a corner, coarser ones beyond.
inline Parameters bed_of_levels(int levels) {
  Parameters p = column(24, 8, 16, 4);
  make_divisible(p);
  p.levels.count = levels;
  p.levels.distance = 2 * spacing;
  p.levels.low = {0, 0, 0};
  p.levels.high = {8 * spacing, 8 * spacing, 8 * spacing};
  return p;
}

/// A bed that slides through the box of fine particles, splitting and merging.
inline Parameters moving_bed(int levels) {
  Parameters p = bed_of_levels(levels);
  p.box.left = p.box.right = FaceKind::periodic;
  p.levels.low = {10 * spacing, 0, 0}, p.levels.high = {12 * spacing, 8 * spacing, 16 * spacing};
  p.bed.velocity = {1, 0, 0};
  return p;
}

/// That bed in air.
inline Parameters moving_bed_in_air(double cell) {
  Parameters p = moving_bed(1);
  p.air.enabled = true;
  p.air.cell = cell;
  p.air.gas.boundaries.kind[0] = p.air.gas.boundaries.kind[1] = FlowBoundary::periodic;
  return p;
}

/// A sector of a silo, whose grains fall past its outlet, splitting above it and merging below, until they are taken
/// away.
inline Parameters sector_of_levels() {
  Parameters p = shut_silo();
  make_divisible(p);
  p.box.sector = std::numbers::pi / 2;
  p.vessel.pop_back();
  p.bed.bottom = 7 * spacing, p.bed.height = 12 * spacing;
  p.bed.velocity = {0, 0, -1};
  p.levels.count = 1;
  p.levels.distance = 2 * spacing;
  p.removal.below = spacing;
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
