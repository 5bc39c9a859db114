// SPDX-License-Identifier: Apache-2.0
/// The loops of the deposition over rows of cells along x. They are separate functions so that the compiler vectorises
/// them. A row has a whole number of vectors of cells; the weights of those that a particle does not reach are 0, and
/// their sums are interleaved, so that vectors of any width add in the same order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vector.hpp"

namespace talus::coupling {

/// Cells of a row that are computed together.
inline constexpr std::size_t row_lanes = 8;

/// Input of the weights of a particle in cells whose places along x are their columns.
struct Reach {
  std::size_t columns;
  const double* square_x;  ///< of the distance along x, m^2
  std::size_t many_y, many_z;
  const double *square_y, *square_z;
  const std::size_t *row_y, *row_z;  ///< of the sum, for each place along y and z
  double square;                     ///< of the reach, m^2
  double per_width;                  ///< over the smoothing length, 1/m
};

/// Adds the kernel at all cells to the rows of `sum`, \p rows_y of them for each place along z.
void weigh_rows(const Reach& reach, std::size_t rows_y, double* __restrict sum);

/// Rounds a row of weights; \returns the sum of what is kept
double round_row(std::size_t columns, const double* row, float* __restrict kept);

/// Adds two amounts to two fields by weight. \param first cell of each row
void add_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight, double amount,
              double other_amount, double* __restrict field, double* __restrict other);

/// Sums of three fields by weight.
Vector3 sum_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight,
                 const double* x, const double* y, const double* z);

}  // namespace talus::coupling
