// SPDX-License-Identifier: Apache-2.0
/// What the sums over particles' neighbours, compiled once for each instruction set, are handed and hand back: plain
/// numbers only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace talus::continuum {

/// A particle or an image of one, as its neighbours see it: what all sums read,
struct alignas(64) MotionRecord {
  double position[3];  ///< m
  double half_length;  ///< half of the smoothing length, m
  double velocity[3];  ///< m/s
  double volume;       ///< m^3
};

/// and what forces read besides.
struct alignas(64) StressRecord {
  double specific_stress[6];  ///< tau/rho^2: xx yy zz xy yz zx, m^5/(kg s^2)
  double half_density;        ///< half of the bulk density, kg/m^3
  double tension;             ///< T/rho^2 of the artificial stress, m^5/(kg s^2)
};

/// The same in single precision. Places are whole numbers of quanta: what two of them differ by is as good as a float,
/// wherever they are. The numbers wrap around far beyond the reach of a particle.
struct alignas(32) SingleMotionRecord {
  std::uint32_t position[3];  ///< in quanta, modulo 2^32
  float half_length;
  float velocity[3];
  float volume;
};
struct alignas(32) SingleStressRecord {
  float specific_stress[6];
  float half_density;
  float tension;
};

/// Neighbours of a particle that load a wall, of those `block` in its list that begin at a multiple of it: the
/// component of their accelerations along `axis`, times `part`, goes to that of the wall. A loop over these has one end
/// to guess, and reads registers as they were written.
struct WallLoad {
  static constexpr std::uint32_t block = 16;
  std::uint32_t first;      ///< place of the block in the list
  std::uint8_t begin, end;  ///< places in the block
  std::uint8_t axis;
  std::uint8_t slot;  ///< in ParticleSums::wall_acceleration
  double part;
};

/// What all pairs have in common.
struct PairConstants {
  double mass;                   ///< of a particle, where all have the same, kg
  double sound_speed;            ///< of the viscosity, m/s
  double viscosity_alpha;        ///< Monaghan's
  double artificial_stress = 0;  ///< epsilon
  double nearness = 0;           ///< one over the kernel's shape at the spacing
};

struct SingleRecords {
  const SingleMotionRecord* motion = nullptr;
  const SingleStressRecord* stress = nullptr;
  double quantum = 0;  ///< m, a power of two
};

/// All records, particles first, then images; the last one is far away from all others (in single precision, where
/// nothing is: with so large a smoothing length that kernel and slope vanish).
struct Records {
  const MotionRecord* motion;
  const StressRecord* stress;
  SingleRecords single;  ///< of the sums in single precision
};

/// Of the neighbours of a particle those up to `end` that are particles (image -1) or seen in one image.
struct NeighbourGroup {
  std::uint32_t end;
  std::int32_t image;
};

/// Neighbours of a particle, by number of their records: first particles, then images, one group after the other. The
/// list goes on to a multiple of `padded_to` with the number of the last record.
struct Neighbours {
  static constexpr std::uint32_t padded_to = 16;
  const std::uint32_t* record;
  const NeighbourGroup* group;
  int groups;
  const WallLoad* load;
  int loads;
  int walls;                   ///< that these load
  std::byte* scratch;          ///< aligned to 64 bytes
  std::uint32_t scratch_size;  ///< in numbers, three times the longest list, padded
};

/// From which the gradient of the stress around a particle follows: sums over its neighbours j, with d = x_j - x_i and
/// w = -V_j F_ij >= 0.
struct alignas(64) StressSums {
  double moment[6];    ///< sum w d d: xx yy zz xy yz zx
  double along[6][3];  ///< of the components of the specific stress: sum w (s_j - s_i) d
};

/// Sums over the neighbours j of i, with d = x_j - x_i.
struct alignas(64) ParticleSums {
  double moment[6];              ///< GradientSums::moment: xx yy zz xy yz zx
  double velocity[9];            ///< GradientSums::velocity: xx xy xz yx yy yz zx zy zz
  double density_rate;           ///< Eq. 16, kg/(m^3 s)
  double stress[8];              ///< sum of W tau_j/rho_j^2, m^2/(kg s^2): xx yy zz xy yz zx, and two unused
  double acceleration[3];        ///< Eq. 17 without gravity, m/s^2
  double kernel_density;         ///< sum of m W without the particle itself, kg/m^3
  double wall_acceleration[20];  ///< that by images, along the normals of the walls that they load, these in order
  StressSums stress_gradient;    ///< where walls ask for them

  static constexpr std::uint32_t together = 8;  ///< particles whose sums go on together
};

enum class PairTerms { all, gradients, forces };

/// Precision of the arithmetic of pairs.
enum class PairPrecision { in_double, in_single };

/// Whether all particles have the mass of PairConstants, or each that of its volume and density.
enum class Masses { equal, unequal };

/// Whether sums of forces sum the stress around a particle too.
enum class StressAround { unasked, asked };

/// Whether sums of forces sum what the gradient of the stress follows from, as walls of a vessel ask; always in double
/// precision.
enum class StressGradient { unasked, asked };

/// Only the requested sums are written.
using SumNeighbours = void (*)(const Records& records, std::uint32_t self, const Neighbours& neighbours,
                               const PairConstants& constants, ParticleSums& sums);

/// The corrected velocity gradients (numerics/sph/velocity_gradient.hpp) of as many particles as there are sums.
/// \param sums of ParticleSums::together particles \param gradient as many numbers for each component, 1/s: xx xy xz yx
/// yy yz zx zy zz
using VelocityGradients = void(const ParticleSums* sums, double (*gradient)[ParticleSums::together]);
VelocityGradients velocity_gradients_portable, velocity_gradients_avx2, velocity_gradients_avx512;

/// \param masses unequal: all sums read stresses, and none is asked for the stress around
using ChooseSumNeighbours = SumNeighbours(PairTerms terms, PairPrecision precision, StressAround stress_around,
                                          StressGradient stress_gradient, Masses masses);
ChooseSumNeighbours sum_neighbours_portable, sum_neighbours_avx2, sum_neighbours_avx512;

}  // namespace talus::continuum
