// SPDX-License-Identifier: Apache-2.0
/// The loops of the deposition over rows of cells along x. They are separate functions so that the compiler vectorises
/// them. A row has a whole number of vectors of cells; the weights of those that a particle does not reach are 0, and
/// their sums are interleaved, so that vectors of any width add in the same order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/vector.hpp"

namespace talus::coupling {

/// Cells of a row that are computed together.
inline constexpr std::size_t row_lanes = 8;

/// Input of the weights of a particle: the cells within reach along each axis, and those that have their shares.
struct Reach {
  std::size_t columns;
  std::size_t many_x, many_y, many_z;
  const float *square_x, *square_y, *square_z;  ///< of the distance over the smoothing length
  const std::size_t* column_x;                  ///< of each position along x; null: in order
  const std::size_t *row_y, *row_z;             ///< of each position along y and z
};

/// What becomes of a row of weights.
enum class RowFate : std::uint8_t { empty, kept, lost };

/// Adds the kernel at all cells, times a constant, to the rows of `sum`, \p rows_y of them for each position along z.
/// \param fate set to `kept` for rows that get any
void weigh_rows(const Reach& reach, std::size_t rows_y, float* __restrict sum, RowFate* __restrict fate);

/// The same of one cell. \param square of its distance over the smoothing length
float weight_at(float square);

/// Copies the rows that are kept, one after another. \returns the sum of their weights and of those that are lost
double keep_rows(std::size_t rows, std::size_t columns, const RowFate* fate, const float* sum, float* __restrict kept);

/// The largest of each `row_lanes` numbers, one after another, at least 0.
void find_max(std::size_t count, const double* number, double* __restrict largest);

/// Adds two amounts to two fields by weight, each rounded to fixed point. \param first cell of each row
/// \param rounding of each field: what rounding_to gives
void add_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight, double amount,
              double other_amount, double rounding, double other_rounding, double* __restrict field,
              double* __restrict other);

/// The same of four, the last three with the second rounding.
void add_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight,
              const double* amount, double rounding, double other_rounding, const std::array<double*, 4>& field);

/// What, added to a smaller number and taken away again, rounds it to a multiple of a power of two. Sums of such
/// multiples are exact, and of no order, as long as they are below 2^53 times as large.
constexpr double rounding_to(double quantum) {
  return 0x1.8p52 * quantum;
}

/// Sums of three fields by weight.
Vector3 sum_rows(std::size_t rows, std::size_t columns, const std::uint32_t* first, const float* weight,
                 const double* x, const double* y, const double* z);

}  // namespace talus::coupling
