// SPDX-License-Identifier: Apache-2.0
/// What the sums over a particle's neighbours, compiled once for each instruction set, are handed and hand back: plain
/// numbers only.
#pragma once

#include <cstdint>

namespace talus::continuum {

/// A particle or an image of one, as its neighbours see it.
struct alignas(128) ParticleRecord {
  double position[3];         ///< m
  double velocity[3];         ///< m/s
  double smoothing_length;    ///< m
  double volume;              ///< m^3
  double specific_stress[6];  ///< tau/rho^2: xx yy zz xy yz zx, m^5/(kg s^2)
  double density;             ///< kg/m^3
  double unused;
};

/// What the stabilisers (physics/sph/stabilisers.hpp) know of a particle besides.
struct alignas(128) StabiliserRecord {
  double density_gradient[3];   ///< kg/m^4
  double velocity_gradient[9];  ///< 1/s, xx xy xz yx yy yz zx zy zz
  double sound_speed;           ///< of the viscosity, m/s
  double loaded;                ///< 1: it bears pressure, else 0
  double dense;                 ///< 1: its density diffuses, else 0
  double unused;
};

/// What all pairs have in common.
struct PairConstants {
  double mass;                                    ///< of a particle, kg
  double sound_speed;                             ///< largest, of the viscosity, m/s
  double viscosity_alpha, viscosity_beta;         ///< Monaghan's
  double density_diffusion = 0;                   ///< 2 delta c, m/s
  double hourglass_damping = 0;                   ///< zeta c, m/s
  const StabiliserRecord* stabilisers = nullptr;  ///< one a record, where stabilisers act
};

/// Neighbours of a particle, by number of their records. Groups follow each other; the first holds particles, each
/// other one the images by one mirror.
struct Neighbours {
  const std::uint32_t* record;
  const std::uint32_t* group_end;  ///< one per group: where it ends in `record`
  int groups;
  std::uint32_t padding;  ///< a record far away from all others, which fills up registers
};

/// Sums over the neighbours j of i, with d = x_j - x_i.
struct PairSums {
  double moment[6];            ///< GradientSums::moment: xx yy zz xy yz zx
  double velocity[9];          ///< GradientSums::velocity: xx xy xz yx yy yz zx zy zz
  double density_rate;         ///< Eq. 16, kg/(m^3 s)
  double kernel_density;       ///< sum of m W without the particle itself, kg/m^3
  double density_gradient[3];  ///< sum of w (rho_j - rho_i) d (GradientSums), where stabilisers are prepared
};

enum class SweepTerms { all, gradients, forces };

/// Whether stabilisers act; before they can, the gradients that they take are measured.
enum class Stabilisers { none, prepared, acting };

/// \param acceleration one per group, of three components: Eq. 17 without gravity, m/s^2; untouched if no forces are
/// requested
using SumNeighbours = void (*)(const ParticleRecord* records, std::uint32_t self, const Neighbours& neighbours,
                               const PairConstants& constants, PairSums& sums, double (*acceleration)[3]);

/// \param stabilisers prepared: of `gradients` only
using ChooseSumNeighbours = SumNeighbours(SweepTerms terms, Stabilisers stabilisers);
ChooseSumNeighbours sum_neighbours_portable, sum_neighbours_avx2, sum_neighbours_avx512;

}  // namespace talus::continuum
