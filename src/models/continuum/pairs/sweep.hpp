// SPDX-License-Identifier: Apache-2.0
/// The sums over pairs: the rates of each particle from its neighbours and their images behind the boundaries.
/// Particles are packed into records, one per particle; images exist only as records, made from those of their sources.
/// The loops themselves are in kernels/, compiled once for each instruction set.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "models/continuum/boundary/vessel_sum.hpp"
#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/pairs/gradient_columns.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"
#include "numerics/neighbourhood.hpp"

namespace talus::continuum {

/// Acceleration of each particle by images, by wall, along the normal of the wall, m/s^2. The tangential parts cancel
/// in the sum over all particles. Only walls that images of the particle's neighbour list load have a value.
struct WallAccelerations {
  std::vector<std::uint32_t> walls;  ///< of a particle, a bit each
  std::vector<std::uint32_t> first;  ///< where its values begin; one more than particles
  std::vector<double> value;         ///< of its walls in order

  /// Calls visit(wall, acceleration) for those of particle i, in order.
  template <class Visit>
  void of(std::size_t i, Visit&& visit) const {
    std::size_t n = first[i];
    for (std::uint32_t left = walls[i]; left != 0; left &= left - 1) visit(std::countr_zero(left), value[n++]);
  }
};

/// Rates of change of every particle, of one evaluation.
struct Rates {
  std::vector<Vector3> acceleration;  ///< from stress and viscosity, without gravity, m/s^2
  std::vector<double> density_rate;   ///< Eq. 16, kg/(m^3 s)
  GradientColumns velocity_gradient;
  std::vector<double> kernel_density;  ///< sum of m W over particles and images, kg/m^3
  /// Sum of W tau/rho^2 over the particle, its neighbours and images, m^2/(kg s^2): xx yy zz xy yz zx; empty unless
  /// stresses are regularised.
  std::array<std::vector<double>, 6> stress_around;
  WallAccelerations by_walls;
  /// By the walls of the vessel, part of the acceleration: of the particles that may meet some, and these.
  std::vector<WallForces> vessel;
  std::vector<std::uint32_t> at_vessel;

  void resize(std::size_t count);
};

/// Input of an evaluation.
struct ParticleView {
  std::span<const Vector3> position;
  std::span<const Vector3> velocity;
  std::span<const double> density;
  std::span<const double> smoothing_length;  ///< of these densities (Sweep::smoothing_length)
  const MaterialColumns& material;
  const std::array<std::vector<double>, 6>& deformation_rate;  ///< State::deformation_rate
};

class Sweep {
 public:
  /// \param domain, vessel, fields outlive the sweep; \param fields of the vessel that note loads, null: none; \param
  /// mass of a particle, kg; \param sound_speed of the viscosity, m/s \throws InputError if the processor does not have
  /// the case's instruction set
  Sweep(const Parameters& parameters, const Domain& domain, double mass, double sound_speed,
        const Surface& vessel = Surface::none(), const SurfaceFields* fields = nullptr);

  /// Smoothing length of a particle, m.
  double smoothing_length(double density) const;
  /// Those of many. \param length of as many, m
  void find_smoothing_lengths(ThreadTeam& team, std::span<const double> density, std::span<double> length) const;

  /// Builds the neighbour lists. \param margin by which a particle may move and grow while they hold, m, at most half
  /// of the skin
  void find_neighbours(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length,
                       std::span<const double> margin);
  /// The same with half of the skin for all.
  void find_neighbours(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length) {
    find_neighbours(team, position, smoothing_length, std::vector<double>(position.size(), 0.5 * skin_));
  }
  double skin() const { return skin_; }  ///< m
  const Neighbourhood& neighbourhood() const { return neighbourhood_; }
  VesselWalls& vessel_walls() { return vessel_; }

  /// Packs the records, then computes the requested rates.
  void operator()(ThreadTeam& team, const ParticleView& particles, SweepTerms terms, Rates& rates);

 private:
  void pack(ThreadTeam& team, const ParticleView& particles, bool stresses);  // pack.cpp
  void pack_double(ThreadTeam& team, const ParticleView& particles, bool stresses);
  void pack_single(ThreadTeam& team, const ParticleView& particles, bool stresses);
  static double quantum_for(double reach);
  /// Whether stabilisers act on these sums, which then read their records, whichever of them act.
  bool are_stabilised(SweepTerms terms) const;
  /// Records of what the stabilisers need (stabilise.cpp).
  void pack_damping(ThreadTeam& team, const ParticleView& particles);
  void pack_diffusion(ThreadTeam& team, const ParticleView& particles);
  void find_groups();
  void add_loads(std::span<const NeighbourGroup> groups, std::uint32_t walls, std::vector<WallLoad>& loads) const;
  /// What of a particle's list it sees at present, where that can change while the list holds; memory of the sums.
  struct Seen {
    struct alignas(64) Line {
      std::byte number[Neighbours::padded_to * sizeof(double)];
    };
    std::vector<Line> scratch;
    std::vector<std::uint32_t> record;
    std::vector<NeighbourGroup> group;
    std::vector<WallLoad> load;
  };
  Neighbours seen_from(std::span<const Vector3> position, std::size_t i, Seen& seen) const;
  void pick_seen(std::span<const Vector3> position, std::size_t i, Seen& seen, Neighbours& found) const;
  Records records() const;
  SymmetricTensor3<> stress_around(const ParticleView& particles, std::size_t i, const PairSums& sums) const;
  /// Adds the walls of the vessel to the sums of a particle's velocity gradient and density rate.
  void add_walls_of_vessel(const ParticleView& particles, std::size_t i, PairSums& sums) const;
  /// Adds the forces of the vessel on a particle, and its share of the kernel's sum. \pre those of pairs are there
  void add_forces_of_vessel(const ParticleView& particles, std::size_t i, const Neighbours& neighbours, PairSums& sums,
                            Rates& rates) const;
  void add_loads_at_vessel(std::size_t i, const Neighbours& neighbours, PairSums& sums) const;

  double mass_;
  double smoothing_ratio_;
  double fixed_smoothing_length_;  // 0: local
  double grain_density_;
  double skin_;
  sph::StressForm stress_form_;
  bool corrected_continuity_;
  bool asks_stress_around_;
  PairPrecision precision_;
  PairConstants constants_;
  std::array<SumNeighbours, 3> sum_, sum_at_vessel_;  // by SweepTerms; that of particles that meet walls of the vessel
  VelocityGradients* velocity_gradients_;
  SumNeighbours density_gradients_ = nullptr;  // null: densities do not diffuse
  bool diffuses_, damps_, local_sound_speed_;
  Neighbourhood neighbourhood_;
  VesselWalls vessel_;
  std::vector<std::array<Domain::Load, 3>> loads_of_images_;
  std::vector<MotionRecord> motion_;  // particles, images, padding
  std::vector<StressRecord> stress_;
  double quantum_ = 0;  // of the places in single precision, m
  std::vector<SingleMotionRecord> single_motion_;
  std::vector<SingleStressRecord> single_stress_;
  std::vector<DampingRecord> damping_;  // of every record, where stabilisers act
  std::vector<DiffusionRecord> diffusion_;
  std::vector<SingleDampingRecord> single_damping_;
  std::vector<SingleDiffusionRecord> single_diffusion_;
  std::vector<std::uint32_t> packed_ghosts_;  // that have records
  std::vector<NeighbourGroup> groups_;        // of every particle's neighbours, one particle after the other
  std::size_t longest_ = 1;                   // list of neighbours
  std::vector<std::uint32_t> first_group_;    // of a particle; one more than particles
  std::vector<WallLoad> loads_;               // of every particle's neighbours
  std::vector<std::uint32_t> first_load_;     // of a particle; one more than particles
  std::vector<std::uint32_t> walls_;          // WallAccelerations::walls
  std::vector<std::uint32_t> first_wall_;     // WallAccelerations::first
};

}  // namespace talus::continuum
