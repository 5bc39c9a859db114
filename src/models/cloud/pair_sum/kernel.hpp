// SPDX-License-Identifier: Apache-2.0
/// What the loops over pairs, compiled once for each instruction set, are handed and hand back: plain numbers only.
#pragma once

#include <cstddef>

#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {

/// Packed columns are as long as a multiple of `padding`, which every vector length divides. A task begins at a
/// multiple of `task_rows` rows; within it pairs are handled in tiles of at most `tile_rows` rows.
inline constexpr std::size_t padding = 16, task_rows = 64, tile_rows = 128;

/// The spheres in the order in which they are packed, padded with spheres without radius and force that lie apart from
/// all others. Lengths in a unit near the largest radius; forces over 8 pi mu times that unit, in m/s.
struct PackedSpheres {
  std::size_t count = 0;   ///< spheres
  std::size_t padded = 0;  ///< with padding
  const double* position[3] = {};
  const double* force[3] = {};
  const double* radius = nullptr;
  const double* size = nullptr;  ///< the sphere's share in the law's finite size (source_size or shared_size)
};

/// Writes to `velocity` (m/s; columns of `padded - row_begin` numbers, the first belonging to sphere row_begin) what
/// the pairs (i, j) with row_begin <= i < row_end and i < j contribute to both spheres. \param row_begin a multiple of
/// task_rows; \param row_end likewise, or beyond the last sphere
using SumRows = void (*)(const PackedSpheres& spheres, std::size_t row_begin, std::size_t row_end,
                         double* const* velocity);

/// The loop for a law (not `none`), 2 or 3 dimensions, double or single precision.
using ChooseSumRows = SumRows(hydrodynamics::Mobility mobility, std::size_t dimensions, bool single_precision);
ChooseSumRows sum_rows_portable, sum_rows_avx2, sum_rows_avx512;

}  // namespace talus::cloud
