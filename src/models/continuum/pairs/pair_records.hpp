// SPDX-License-Identifier: Apache-2.0
/// The records that the pair sums read, one per particle; images exist only as records, made from those of their
/// sources.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"
#include "models/continuum/pairs/pair_lists.hpp"
#include "models/continuum/pairs/rates.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "physics/sph/balance.hpp"

namespace talus::continuum {

/// tau/rho^2 of a particle, in the form of Eq. 17 that the case takes, m^5/(kg s^2). Within the loop over the
/// particles: what a call returns by memory, in halves of what is then read, is waited for. \param grain_density kg/m^3
[[gnu::always_inline]] inline SymmetricTensor3<> specific_stress(const ParticleView& particles, std::size_t i,
                                                                 sph::StressForm form, double grain_density) {
  const double density = particles.density[i];
  const double packing = form == sph::StressForm::printed ? density / grain_density : 1;  // else unused
  return sph::specific_stress(stress_of(particles.material, i), density, packing, form);
}

class PairRecords {
 public:
  struct Options {
    double mass;           ///< of a particle of mass ratio 1, kg
    double grain_density;  ///< kg/m^3
    sph::StressForm stress_form;
    PairPrecision precision;
    bool tension;        ///< whether the artificial stress needs it
    bool always_double;  ///< with single precision of the pairs, too: the walls of a vessel read double precision
  };
  explicit PairRecords(const Options& options) : options_(options) {}

  /// Takes what lists the particles beside walls have: all that is packed in double precision besides single.
  /// \param at_walls numbers of these particles
  void find_read_by_walls(const PairLists& lists, std::span<const std::uint32_t> at_walls);

  /// Motion of particles and images. \param stresses whether stresses, too: only forces read them
  void pack(ThreadTeam& team, const PairLists& lists, const ParticleView& particles, bool stresses);

  Records view() const;

 private:
  void pack_double(ThreadTeam& team, const PairLists& lists, const ParticleView& particles, bool stresses);
  void pack_single(ThreadTeam& team, const PairLists& lists, const ParticleView& particles, bool stresses);

  Options options_;
  std::vector<std::uint32_t> wall_particles_, wall_ghosts_;  // of find_read_by_walls, rising
  double quantum_ = 0;                                       // of the places in single precision, m
  // Particles, images, padding.
  std::vector<MotionRecord> motion_;
  std::vector<StressRecord> stress_;
  std::vector<SingleMotionRecord> single_motion_;
  std::vector<SingleStressRecord> single_stress_;
};

}  // namespace talus::continuum
