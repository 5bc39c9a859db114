// SPDX-License-Identifier: Apache-2.0
/// The sums over pairs: the rates of each particle from its neighbours, their images behind the boundaries and the
/// walls of a vessel. Lists, records and wall sums are its parts; the loops themselves are in kernels/, compiled once
/// for each instruction set.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"
#include "models/continuum/pairs/pair_lists.hpp"
#include "models/continuum/pairs/pair_records.hpp"
#include "models/continuum/pairs/rates.hpp"
#include "models/continuum/pairs/wall_sums.hpp"
#include "models/continuum/setup/setup.hpp"

namespace talus::continuum {

class PairSums {
 public:
  /// \param domain, vessel of the boundary \param fields of the vessel that note loads, null: none. All three outlive
  /// the sums
  /// \throws InputError if the processor does not have the case's instruction set
  PairSums(const Setup& setup, const Domain& domain, const Surface& vessel = Surface::none(),
           const SurfaceFields* fields = nullptr);

  /// Smoothing length of a particle, m.
  double smoothing_length(double density, double mass_ratio = 1) const;
  /// Those of many. \param mass_ratio of as many, empty: 1 \param length of as many, m
  void find_smoothing_lengths(ThreadTeam& team, std::span<const double> density, std::span<const double> mass_ratio,
                              std::span<double> length) const;

  /// Builds the neighbour lists. \param margin by which a particle may move and grow while they hold, m, at most half
  /// of the skin \param mass_ratio of the particles, empty: 1 \param part of the particles that other processes own
  void find_neighbours(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length,
                       std::span<const double> margin, std::span<const double> mass_ratio = {},
                       const PartOfPoints& part = {});
  /// The same with half of the skin for all.
  void find_neighbours(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length) {
    find_neighbours(team, position, smoothing_length, std::vector<double>(position.size(), 0.5 * skin_));
  }
  double skin() const { return skin_; }  ///< m
  /// Linear coefficient of Monaghan's viscosity, in the sums from now on.
  void set_viscosity(double alpha) { constants_.viscosity_alpha = alpha; }
  const Neighbourhood& neighbourhood() const { return lists_.neighbourhood(); }
  VesselWalls& vessel_walls() { return vessel_; }

  PairSums(const PairSums&) = delete;
  PairSums& operator=(const PairSums&) = delete;

  /// Packs the records, then computes the requested rates. \pre columns hold the halo's values too
  void operator()(ThreadTeam& team, const ParticleView& particles, PairTerms terms, Rates& rates);

 private:
  void pack(ThreadTeam& team, const ParticleView& particles, PairTerms terms);
  void make_room(PairTerms terms, std::size_t count, Rates& rates) const;
  SymmetricTensor3<> stress_around(const ParticleView& particles, std::size_t i, const ParticleSums& sums) const;

  double mass_;  // of mass ratio 1
  Masses masses_;
  double smoothing_ratio_;
  double fixed_smoothing_length_;  // 0: local
  double grain_density_;
  double skin_;
  sph::StressForm stress_form_;
  bool asks_stress_around_;
  PairPrecision precision_;
  PairConstants constants_;
  std::array<SumNeighbours, 3> sum_, sum_at_vessel_;  // by PairTerms; that of particles that meet walls of the vessel
  VelocityGradients* velocity_gradients_;
  PairLists lists_;
  VesselWalls vessel_;
  WallSums walls_;
  PairRecords records_;
};

}  // namespace talus::continuum
