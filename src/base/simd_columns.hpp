// SPDX-License-Identifier: Apache-2.0
/// Columns of tables in vectors, and sums over their lanes.
#pragma once

#include "base/simd.hpp"

namespace talus {
inline namespace TALUS_INSTRUCTION_SET {

/// Columns of a table whose rows are elsewhere in memory: column c of the rows that the lanes choose.
/// \param row_of lane -> const T*, of doubles aligned to half a register \param columns as many as the table has, a
/// multiple of 8
template <int columns, class T, class RowOf>
TALUS_INLINE void load_columns(RowOf&& row_of, SimdVector<T> (&column)[columns]) {
  using Register = typename SimdVector<T>::Register;
  constexpr int lanes = SimdVector<T>::lanes, at_once = sizeof(T) == 8 ? lanes : 8;
  const T* row[lanes];
  TALUS_UNROLL for (int k = 0; k < lanes; ++k) row[k] = row_of(k);
  TALUS_UNROLL for (int c = 0; c < columns; c += at_once) {
    Register block[at_once];
    registers::load_transposed(row, static_cast<std::size_t>(c), block);
    TALUS_UNROLL for (int k = 0; k < at_once; ++k) column[c + k].row[0] = block[k];
  }
}

/// Writes the sum over the lanes of each of x, in a fixed order. \param count a multiple of 8, of floats of 4; \param
/// sum aligned to a register, as many
template <int count>
TALUS_INLINE void store_sums(const SimdVector<double> (&x)[count], double* sum) {
  using Register = SimdVector<double>::Register;
  constexpr int lanes = SimdVector<double>::lanes;
  TALUS_UNROLL for (int c = 0; c < count; c += lanes) {
    Register block[lanes];
    TALUS_UNROLL for (int k = 0; k < lanes; ++k) block[k] = x[c + k].row[0];
    *reinterpret_cast<Register*>(sum + c) = registers::sums(block);
  }
}

/// The same in floats, summed in floats: as many at once as a register has lanes, then four.
template <int count>
TALUS_INLINE void store_sums(const SimdVector<float> (&x)[count], double* sum) {
  using Register = SimdVector<float>::Register;
  constexpr int lanes = SimdVector<float>::lanes, whole = count / lanes * lanes;
  TALUS_UNROLL for (int c = 0; c < whole; c += lanes) {
    Register block[lanes];
    TALUS_UNROLL for (int k = 0; k < lanes; ++k) block[k] = x[c + k].row[0];
    registers::store_as_doubles(registers::sums(block), sum + c);
  }
  TALUS_UNROLL for (int c = whole; c < count; c += 4) {
    Register block[4];
    TALUS_UNROLL for (int k = 0; k < 4; ++k) block[k] = x[c + k].row[0];
    registers::store_as_doubles(registers::sums_of_four(block), sum + c);
  }
}

}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus
