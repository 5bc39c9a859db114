// SPDX-License-Identifier: Apache-2.0
/// What the loops over near pairs of the spectral sum, compiled once for each instruction set, are handed and hand
/// back: plain numbers only. Lengths in units of the cut-off; the edge of a cell is half of it.
#pragma once

#include <cstddef>

#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {

/// Cells on either side that hold neighbours of a cell.
inline constexpr std::size_t near_reach = 2;
/// Rows of cells that hold the neighbours of a cell: its own, in the middle, and those around it.
inline constexpr std::size_t near_rows(int dimensions) {
  return dimensions == 2 ? 5 : 25;
}

/// Numbers of work space a neighbour, and of neighbours that are rounded up to.
inline constexpr std::size_t near_columns(int dimensions) {
  return 2 * static_cast<std::size_t>(dimensions) + 3;
}
inline constexpr std::size_t near_padding = 16;

/// Columns of all spheres in the order of their cells, row by row.
template <class T, int dimensions>
struct SortedSpheres {
  const T* position[dimensions] = {};  ///< from the corner of the sphere's cell
  const T* cell = nullptr;             ///< number of the cell in its row
  const T* force[dimensions] = {};
  const T* size = nullptr;  ///< share in the law's finite size (source_size or shared_size)
  const T* radius = nullptr;
};

/// Some cells of a row that follow each other, and the spheres in and around them.
template <class T, int dimensions>
struct NearBlock {
  /// Neighbours, row by row: the next layer's follow after five.
  std::size_t begin[near_rows(dimensions)] = {}, end[near_rows(dimensions)] = {};
  std::size_t first = 0, last = 0;  ///< the targets, among the spheres of the middle row
  T first_cell = 0;                 ///< of the targets
};

/// Writes the sums over near pairs of the tensor less its smooth part, of each target its own with itself included.
/// \param polynomial Split::polynomials of the degree that the loop is for
/// \param space near_columns times the neighbours and near_padding, rounded up to near_padding; aligned to 64 bytes
/// \param velocity a column for each dimension, in the order of the spheres
template <class T, int dimensions>
using SumNear = void (*)(const SortedSpheres<T, dimensions>& spheres, const NearBlock<T, dimensions>& block,
                         const T* polynomial, T* space, T* const* velocity);

/// The loop for a law (not `none`) and a degree (7 or 9 in single precision, 12 in double). For 2 and 3 dimensions.
template <class T, int dimensions>
SumNear<T, dimensions> sum_near_portable(hydrodynamics::Mobility mobility, int degree);
template <class T, int dimensions>
SumNear<T, dimensions> sum_near_avx2(hydrodynamics::Mobility mobility, int degree);
template <class T, int dimensions>
SumNear<T, dimensions> sum_near_avx512(hydrodynamics::Mobility mobility, int degree);

}  // namespace talus::cloud
