// SPDX-License-Identifier: Apache-2.0
/// What the sums of a particle at a wall, compiled once for each instruction set, are handed and hand back.
#pragma once

#include <cstdint>

#include "models/continuum/pairs/kernels/kernel.hpp"

namespace talus::continuum {

/// A point of a wall, in single precision, its place as SingleMotionRecord has it: a sum over points is right to a few
/// thousandths.
struct alignas(32) WallPoint {
  std::uint32_t place[3];  ///< in quanta, modulo 2^32
  float normal[3];         ///< unit
  float area;              ///< m^2
  float unused;
};

/// Some points of a wall. \pre count is a multiple of `padded_to`; points without area fill up
struct WallPoints {
  static constexpr std::uint32_t padded_to = 16;
  const WallPoint* all;
  const std::uint32_t* number;
  std::uint32_t count;
  double quantum;  ///< of the places, m
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
  static constexpr std::uint32_t padded_to = 8;
  const std::uint32_t* record;  ///< number of each, padded as Neighbours::record
  const std::uint32_t* seat;    ///< and of its seat; the padding's share is 0
  std::uint32_t count;
};

/// Functions that are compiled once for each instruction set.
struct WallKernels {
  /// \param place of the particle, in quanta; \param h its smoothing length, m
  void (*points)(const WallPoints& points, const std::uint32_t* place, double h, WallTotals& totals);
  /// The acceleration of a particle along a part of a wall by the images of others there (pairs/wall_sums.hpp).
  /// \param mass of a particle, kg, 0: each has that of its volume and density; \param acceleration 3 numbers and one
  /// of no meaning, aligned, m/s^2
  void (*images)(const Records& records, std::uint32_t self, const WallSeat& own, const WallSeat* seats,
                 const WallPairs& others, double mass, double* acceleration);
};

WallKernels wall_kernels_portable(), wall_kernels_avx2(), wall_kernels_avx512();

}  // namespace talus::continuum
