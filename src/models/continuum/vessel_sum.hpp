// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel add to the sums over a particle's neighbours. Beyond a wall the field around the particle
/// is taken to go on: the stress linearly, its shear along the wall turned over as in a mirror, so that the wall pulls
/// at nothing along itself (friction is Coulomb's, walls.hpp); the velocity along the wall linearly too, and that across
/// it linearly through 0 at the wall. The density is the particle's.
#pragma once

#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "models/continuum/pair_sweep/kernel.hpp"
#include "models/continuum/vessel_walls.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

/// The force of a smooth part of a wall on a particle.
struct WallForce {
  std::uint32_t patch = 0;
  Vector3 normal;        ///< unit, towards the particle
  Vector3 acceleration;  ///< m/s^2
};
struct WallForces {
  std::array<WallForce, most_near_walls> of;
  std::size_t count = 0;

  std::span<const WallForce> all() const { return std::span(of).first(count); }
};

/// Adds the walls to the sums of the velocity's gradient. \param velocity of the particle, m/s
/// \returns what they add to the rate of the density, over the density, 1/s
double add_walls(const NearWalls& met, const Vector3& velocity, sph::GradientSums<>& sums);

/// The forces of the walls on a particle, in the order of `met`. \param records, neighbours those of the sweep
WallForces forces_of_walls(const NearWalls& met, const ParticleRecord* records, std::size_t self,
                           const Neighbours& neighbours, const PairConstants& constants, double sound_speed);

}  // namespace talus::continuum
