// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel add to the pair sums of a particle.
#pragma once

#include "models/continuum/boundary/vessel_sum.hpp"
#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/pairs/pair_lists.hpp"
#include "models/continuum/pairs/rates.hpp"

namespace talus::continuum {

class WallSums {
 public:
  /// \param walls, lists, constants outlive the sums
  /// \param local_sound_speed whether a particle without pressure has no viscosity at walls
  WallSums(const VesselWalls& walls, const PairLists& lists, const PairConstants& constants, bool local_sound_speed)
      : walls_(walls), lists_(lists), constants_(constants), local_sound_speed_(local_sound_speed) {}

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
  bool local_sound_speed_;
};

}  // namespace talus::continuum
