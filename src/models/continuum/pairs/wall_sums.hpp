// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel add to the sums over a particle's neighbours.
///
/// Across the wall. Beyond a wall the field around the particle is taken to go on: the stress linearly, its shear along
/// the wall turned over as in a mirror; the velocity along the wall linearly too, and that across it linearly through 0
/// at the wall. The density is the particle's. The wall pushes along its normal only: friction is Coulomb's
/// (boundary/contact.hpp).
///
/// Along the wall. A particle beside a wall has neighbours on one side only; what lacks is the force along the wall of
/// the neighbours' images in it. At the distances a and b of two particles from a plane, each is at the distance
/// (r^2 + 4 a b)^(1/2) from the other's image, and the forces along the wall are equal and opposite: the wall, which is
/// smooth, has no part in them. Where a wall covers a part of its plane only, at a rim or a corner, the images count by
/// the mean of the shares that both particles see (kernels/sum_walls_for_set.cpp).
#pragma once

#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/pairs/pair_lists.hpp"
#include "models/continuum/pairs/rates.hpp"

namespace talus::continuum {

class WallSums {
 public:
  /// \param walls, lists, constants outlive the sums
  WallSums(const VesselWalls& walls, const PairLists& lists, const PairConstants& constants)
      : walls_(walls), lists_(lists), constants_(constants) {}

  /// To the sums of a particle's velocity gradient and density rate.
  void add_gradients(const ParticleView& particles, std::size_t i, ParticleSums& sums) const;
  /// The forces of the vessel on a particle, and its share of the kernel's sum. \pre those of pairs are there
  void add_forces(const ParticleView& particles, std::size_t i, const Records& records, const Neighbours& neighbours,
                  ParticleSums& sums, Rates& rates) const;

 private:
  void add_loads(std::size_t i, const Records& records, const Neighbours& neighbours, ParticleSums& sums) const;

  const VesselWalls& walls_;
  const PairLists& lists_;
  const PairConstants& constants_;
};

}  // namespace talus::continuum
