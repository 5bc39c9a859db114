// SPDX-License-Identifier: Apache-2.0
/// What the sums of a particle at a wall, compiled once for each instruction set, are handed and hand back.
#pragma once

#include <cstdint>

#include "models/continuum/pair_sweep/kernel.hpp"

namespace talus::continuum {

/// A point of a wall.
struct alignas(64) WallPoint {
  double place[3];   ///< m
  double normal[3];  ///< unit
  double area;       ///< m^2
  double unused;
};

/// sph::WallSums, in its order.
struct alignas(64) WallTotals {
  double density = 0;
  double slope[3] = {}, moment[6] = {}, closing[3] = {}, normal[3] = {};
  double nearness = 0, weight = 0, distance = 0;
  double unused[5] = {};
};

/// How a particle, or an image of one, stands at a smooth part of a wall.
struct alignas(64) WallSeat {
  double normal[3] = {};  ///< unit, towards it
  double distance = 0;    ///< from the wall, m
  double share = 0;       ///< that the wall covers of a plane without end, 0 to 1; 0: it does not stand there
  double unused[3] = {};
};

/// Those that stand with a particle at a part of a wall.
struct WallPairs {
  const std::uint32_t* record;  ///< number of each, padded to whole registers as Neighbours::record
  const std::uint32_t* seat;    ///< and of its seat; the padding's share is 0
  std::uint32_t count;
};

/// Sums over the neighbours j of i, with d = x_j - x_i and w = -V_j F_ij >= 0.
struct alignas(64) StressSums {
  double moment[6];    ///< sum w d d: xx yy zz xy yz zx
  double along[6][3];  ///< of the components of the specific stress: sum w (s_j - s_i) d
};

/// Functions that are compiled once for each instruction set.
struct WallSweep {
  /// \param numbers of the `count` points; \param padding number of a point without area, which fills up registers
  /// \param position of the particle, m; \param h its smoothing length, m
  void (*points)(const WallPoint* points, const std::uint32_t* numbers, std::uint32_t count, std::uint32_t padding,
                 const double* position, double h, WallTotals& totals);
  /// The acceleration of a particle along a part of a wall by the images of others there (vessel_sum.hpp).
  /// \param mass of a particle, kg; \param acceleration 3 numbers and one of no meaning, aligned, m/s^2
  void (*images)(const Records& records, std::uint32_t self, const WallSeat& own, const WallSeat* seats,
                 const WallPairs& others, double mass, double* acceleration);
  /// \param neighbours those up to the end of the last group
  void (*stresses)(const Records& records, std::uint32_t self, const Neighbours& neighbours, StressSums& sums);
};

WallSweep wall_sweep_portable(), wall_sweep_avx2(), wall_sweep_avx512();

}  // namespace talus::continuum
