// SPDX-License-Identifier: Apache-2.0
/// The sums over pairs: the rates of each particle from its neighbours and their images behind the boundaries.
/// Particles are packed into records, one per particle; images exist only as records, made from those of their sources.
/// The loops themselves are in pair_sweep/, compiled once for each instruction set.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/tensor.hpp"
#include "models/continuum/pair_sweep/kernel.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/vessel_sum.hpp"
#include "models/continuum/vessel_walls.hpp"
#include "numerics/neighbourhood.hpp"

namespace talus::continuum {

/// Rates of change of every particle, of one evaluation.
struct Rates {
  std::vector<Vector3> acceleration;         ///< from stress and viscosity, without gravity, m/s^2
  std::vector<double> density_rate;          ///< Eq. 16, kg/(m^3 s)
  std::vector<Tensor3<>> velocity_gradient;  ///< du_i/dx_j, 1/s
  std::vector<double> kernel_density;        ///< sum of m W over particles and images, kg/m^3
  /// Acceleration by images, by wall, along the normal of the wall, m/s^2. The tangential parts cancel in the sum over
  /// all particles.
  std::vector<std::array<double, most_walls>> wall_acceleration;
  std::vector<WallForces> vessel;  ///< by the walls of the vessel, part of the acceleration; empty without one

  void resize(std::size_t count);
};

/// Input of an evaluation.
struct ParticleView {
  std::span<const Vector3> position;
  std::span<const Vector3> velocity;
  std::span<const double> density;
  std::span<const double> smoothing_length;  ///< of these densities (Sweep::smoothing_length)
  const MaterialColumns& material;
};

class Sweep {
 public:
  /// \param domain, vessel outlive the sweep; \param mass of a particle, kg; \param sound_speed of the viscosity, m/s
  /// \throws InputError if the processor does not have the case's instruction set
  Sweep(const Parameters& parameters, const Domain& domain, double mass, double sound_speed,
        const Surface& vessel = Surface::none());

  /// Smoothing length of a particle, m.
  double smoothing_length(double density) const;

  /// Builds the neighbour lists.
  void find_neighbours(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length);
  const Neighbourhood& neighbourhood() const { return neighbourhood_; }

  /// Packs the records, then computes the requested rates.
  void operator()(ThreadTeam& team, const ParticleView& particles, SweepTerms terms, Rates& rates);

 private:
  struct Group {
    std::uint32_t end;   ///< within the particle's neighbours
    std::int32_t image;  ///< of the group, -1: particles
  };

  void pack(ThreadTeam& team, const ParticleView& particles);
  /// Computes the gradients that the stabilisers need from the packed records, and packs them (stabilise.cpp).
  void prepare_stabilisers(ThreadTeam& team, const ParticleView& particles);
  void find_groups();
  Neighbours seen_from(std::size_t i, std::vector<std::uint32_t>& record, std::vector<std::uint32_t>& end) const;
  /// The share of the kernel's sum that is beyond the walls of the vessel. \pre the forces of the particles are summed
  double add_forces_of_vessel(const ParticleView& particles, std::size_t i, const Neighbours& neighbours,
                              Rates& rates) const;
  /// Wall and normal as another particle, or an image of one, meets the same part of a wall.
  SeatAtWall seat_at_wall(std::uint32_t record, std::uint32_t part) const;

  double mass_;
  double smoothing_ratio_;
  double fixed_smoothing_length_;  // 0: local
  double grain_density_;
  double skin_;
  sph::StressForm stress_form_;
  bool corrected_continuity_;
  PairConstants constants_;
  std::array<SumNeighbours, 3> sum_;     // by SweepTerms
  SumNeighbours prepare_sum_ = nullptr;  // null: no stabilisers
  bool local_sound_speed_;
  std::vector<StabiliserRecord> stabilisers_;  // of every record
  Neighbourhood neighbourhood_;
  VesselWalls vessel_;
  std::vector<std::array<Domain::Load, 3>> loads_;  // by image
  std::vector<ParticleRecord> records_;             // particles, images, padding
  std::vector<Group> groups_;                       // of every particle's neighbours, one particle after the other
  std::vector<std::uint32_t> first_group_;          // of a particle; one more than particles
};

}  // namespace talus::continuum
