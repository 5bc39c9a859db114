// SPDX-License-Identifier: Apache-2.0
/// Input and output of an evaluation of the pair sums: columns of the particles, and their rates of change.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/state.hpp"

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

/// The force of a smooth part of a wall on a particle.
struct WallForce {
  std::uint32_t patch = 0;
  FieldShare fields;      ///< NearWall::fields
  Vector3 normal;         ///< unit, towards the particle
  Vector3 acceleration;   ///< m/s^2
  double per_stress = 0;  ///< its size by a normal stress of 1 Pa, m/(s^2 Pa)
};
struct WallForces {
  std::size_t count = 0;  // stands first: with the first force it is all that most particles need
  std::array<WallForce, max_near_walls> of;

  std::span<const WallForce> all() const { return std::span(of).first(count); }
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
  std::span<const double> smoothing_length;  ///< of these densities (PairSums::smoothing_length)
  const MaterialColumns& material;
  MassRatios mass_ratio = {};  ///< State::ratios
};

}  // namespace talus::continuum
