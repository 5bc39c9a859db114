// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel add to the sums over a particle's neighbours.
///
/// Across the wall. Beyond a wall the field around the particle is taken to go on: the stress linearly, its shear along
/// the wall turned over as in a mirror; the velocity along the wall linearly too, and that across it linearly through 0
/// at the wall. The density is the particle's. The wall pushes along its normal only: friction is Coulomb's
/// (walls.hpp).
///
/// Along the wall. A particle beside a wall has neighbours on one side only; what lacks is the force along the wall of
/// the neighbours' images in it. At the distances a and b of two particles from a plane, each is at the distance
/// (r^2 + 4 a b)^(1/2) from the other's image, and the forces along the wall are equal and opposite: the wall, which is
/// smooth, has no part in them. Where a wall covers a part of its plane only, at a rim or a corner, the images count by
/// the mean of the shares that both particles see (kernels/sum_walls.hpp).
#pragma once

#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

/// The force of a smooth part of a wall on a particle.
struct WallForce {
  std::uint32_t patch = 0;
  std::uint32_t field = 0;  ///< NearWall::field
  Vector3 normal;           ///< unit, towards the particle
  Vector3 acceleration;     ///< m/s^2
};
struct WallForces {
  std::size_t count = 0;  // stands first: with the first force it is all that most particles need
  std::array<WallForce, most_near_walls> of;

  std::span<const WallForce> all() const { return std::span(of).first(count); }
};

/// Adds the walls to the sums of the velocity's gradient. \param velocity of the particle, m/s
/// \returns what they add to the rate of the density, over the density, 1/s
double add_walls(NearWalls met, const Vector3& velocity, sph::GradientSums<>& sums);

/// Writes the forces of the walls on a particle, in the order in which it meets them. \param records of the pairs
/// \param sums over the particle's neighbours
void find_forces_of_walls(const VesselWalls& walls, const Records& records, std::size_t self, const StressSums& sums,
                          const PairConstants& constants, double sound_speed, WallForces& forces);

}  // namespace talus::continuum
