// SPDX-License-Identifier: Apache-2.0
/// What the loops over near pairs of the spectral sum, compiled once for each instruction set, are handed and hand
/// back: plain numbers only. Lengths in units of the cut-off; the edge of a cell is half of it.
#pragma once

#include <cstddef>

#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {

/// Rows of cells that hold the neighbours of a cell: its own and two on either side.
inline constexpr int near_rows = 5;

/// Numbers of work space a neighbour, and of neighbours that are rounded up to.
inline constexpr std::size_t near_columns = 7, near_padding = 16;

/// Columns of all spheres in the order of their cells, row by row.
template <class T>
struct SortedSpheres {
  const T* position[2] = {};  ///< from the corner of the sphere's cell
  const T* cell = nullptr;    ///< number of the cell in its row
  const T* force[2] = {};
  const T* size = nullptr;  ///< share in the law's finite size (source_size or shared_size)
  const T* radius = nullptr;
};

/// Some cells of a row that follow each other, and the spheres in and around them.
template <class T>
struct NearBlock {
  std::size_t begin[near_rows] = {}, end[near_rows] = {};  ///< neighbours, row by row
  std::size_t first = 0, last = 0;                         ///< the targets, among those of the middle row
  T first_cell = 0;                                        ///< of the targets
};

/// Writes the sums over near pairs of the tensor less its smooth part, of each target its own with itself included.
/// \param polynomial Split::polynomials of the degree that the loop is for
/// \param space near_columns times the neighbours and near_padding, rounded up to near_padding; aligned to 64 bytes
/// \param velocity two columns, in the order of the spheres
template <class T>
using SumNear = void (*)(const SortedSpheres<T>& spheres, const NearBlock<T>& block, const T* polynomial, T* space,
                         T* const* velocity);

/// The loop for a law (not `none`) and a degree (7, 9 or 12).
template <class T>
using ChooseSumNear = SumNear<T>(hydrodynamics::Mobility mobility, int degree);
ChooseSumNear<float> sum_near_portable, sum_near_avx2, sum_near_avx512;
ChooseSumNear<double> sum_near_double_portable, sum_near_double_avx2, sum_near_double_avx512;

}  // namespace talus::cloud
