// SPDX-License-Identifier: Apache-2.0
/// SIMD vectors: `SimdVector<T, rows>` holds `rows` vector registers of doubles or floats and computes with all of them
/// at once. A law written as a template over its number type works on double, on float and on SIMD vectors alike, with
/// `select` in place of branches. Several rows in one number keep several independent chains of operations in flight,
/// which is what hides the latency of each; a single row is combined with every row of its partner.
///
/// The instruction set is the one that the including file is compiled for, and everything here lives in a namespace of
/// its name: two files compiled for different sets share no function.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "base/registers_of_floats.hpp"

namespace talus {

// Scalars. Products and sums are rounded separately.
template <class T>
concept Scalar = std::is_floating_point_v<T>;

template <Scalar T>
TALUS_INLINE constexpr T multiply_add(T a, T b, T c) {
  return a * b + c;
}
template <Scalar T>
TALUS_INLINE constexpr T negative_multiply_add(T a, T b, T c) {
  return c - a * b;
}
template <Scalar T>
TALUS_INLINE constexpr T select(bool condition, T yes, T no) {
  return condition ? yes : no;
}
TALUS_INLINE constexpr bool all(bool condition) {
  return condition;
}
template <Scalar T>
TALUS_INLINE T reciprocal_sqrt(T x) {
  return T(1) / std::sqrt(x);
}
template <Scalar T>
TALUS_INLINE constexpr T minimum(T a, T b) {
  return a > b ? b : a;
}
template <Scalar T>
TALUS_INLINE constexpr T maximum(T a, T b) {
  return a > b ? a : b;
}
/// f of every number of x; for a scalar f(x).
template <Scalar T, class Function>
TALUS_INLINE T map_lanes(T x, Function&& f) {
  return f(x);
}
/// Fills `values` from a row of memory that each number of x chooses. \param row_of number -> const T2*, at least
/// `count` long
template <int count, Scalar T, class RowOf>
TALUS_INLINE void gather_rows(T x, RowOf&& row_of, T (&values)[count]) {
  const auto* row = row_of(x);
  for (int k = 0; k < count; ++k) values[k] = static_cast<T>(row[k]);
}

inline namespace TALUS_INSTRUCTION_SET {

template <class T, int rows = 1>
struct SimdVector {
  using Register = typename registers::Of<T>::Register;
  static constexpr int lanes = registers::bytes / sizeof(T);  ///< numbers in a row
  Register row[rows];

  SimdVector() = default;
  /// The same number everywhere. Implicit, so that laws can be written alike for scalars and vectors.
  TALUS_INLINE SimdVector(double value) {  // NOLINT(google-explicit-constructor)
    TALUS_UNROLL for (int r = 0; r < rows; ++r) row[r] = static_cast<T>(value) - Register{};
  }
  /// One number per row, repeated over its lanes. \param values `rows` numbers
  TALUS_INLINE static SimdVector broadcast(const T* values) {
    SimdVector x;
    TALUS_UNROLL for (int r = 0; r < rows; ++r) x.row[r] = values[r] - Register{};
    return x;
  }
  /// Row r holds first + r.
  TALUS_INLINE static SimdVector ramp_of_rows(std::size_t first) {
    SimdVector x;
    TALUS_UNROLL for (int r = 0; r < rows; ++r) {
      x.row[r] = Register{} + static_cast<T>(first + static_cast<std::size_t>(r));
    }
    return x;
  }
  /// Lane k holds first + k.
  TALUS_INLINE static SimdVector ramp(std::size_t first) requires(rows == 1) {
    SimdVector x;
    for (int k = 0; k < lanes; ++k) x.row[0][k] = static_cast<T>(first + static_cast<std::size_t>(k));
    return x;
  }
  /// One row from memory, and to it. \param values aligned to a register
  TALUS_INLINE static SimdVector load(const T* values) requires(rows == 1) {
    SimdVector x;
    x.row[0] = *reinterpret_cast<const Register*>(values);
    return x;
  }
  TALUS_INLINE void store(T* values) const requires(rows == 1) { *reinterpret_cast<Register*>(values) = row[0]; }
  /// One row from anywhere in memory.
  TALUS_INLINE static SimdVector load_unaligned(const T* values) requires(rows == 1) {
    SimdVector x;
    __builtin_memcpy(&x.row[0], values, sizeof(Register));
    return x;
  }
};

template <class T, int rows>
struct SimdMask {
  typename registers::Of<T>::Mask row[rows];
};

// Binary operations: a single row meets every row of the other.
#define TALUS_SIMD_OPERATOR(symbol)                                                                     \
  template <class T, int p, int q>                                                                      \
  TALUS_INLINE SimdVector<T, (p > q ? p : q)> operator symbol(SimdVector<T, p> a, SimdVector<T, q> b) { \
    SimdVector<T, (p > q ? p : q)> c;                                                                   \
    TALUS_UNROLL for (int r = 0; r < (p > q ? p : q); ++r) c.row[r] = a.row[r % p] symbol b.row[r % q]; \
    return c;                                                                                           \
  }                                                                                                     \
  template <class T, int p>                                                                             \
  TALUS_INLINE SimdVector<T, p> operator symbol(double a, SimdVector<T, p> b) {                         \
    return SimdVector<T>(a) symbol b;                                                                   \
  }                                                                                                     \
  template <class T, int p>                                                                             \
  TALUS_INLINE SimdVector<T, p> operator symbol(SimdVector<T, p> a, double b) {                         \
    return a symbol SimdVector<T>(b);                                                                   \
  }
TALUS_SIMD_OPERATOR(+)
TALUS_SIMD_OPERATOR(-)
TALUS_SIMD_OPERATOR(*)
TALUS_SIMD_OPERATOR(/)
#undef TALUS_SIMD_OPERATOR

/// a b + c, rounded once (portable: twice).
template <class T, int p, int q, int s>
TALUS_INLINE auto multiply_add(SimdVector<T, p> a, SimdVector<T, q> b, SimdVector<T, s> c) {
  constexpr int rows = p > q ? (p > s ? p : s) : (q > s ? q : s);
  SimdVector<T, rows> d;
  TALUS_UNROLL for (int r = 0; r < rows; ++r) d.row[r] = registers::fused(a.row[r % p], b.row[r % q], c.row[r % s]);
  return d;
}

/// c - a b, rounded once (portable: twice).
template <class T, int p, int q, int s>
TALUS_INLINE auto negative_multiply_add(SimdVector<T, p> a, SimdVector<T, q> b, SimdVector<T, s> c) {
  constexpr int rows = p > q ? (p > s ? p : s) : (q > s ? q : s);
  SimdVector<T, rows> d;
  TALUS_UNROLL for (int r = 0; r < rows; ++r) {
    d.row[r] = registers::negative_fused(a.row[r % p], b.row[r % q], c.row[r % s]);
  }
  return d;
}

/// Sum over the rows, one after the other, of a b, added to c.
template <class T, int p, int q>
TALUS_INLINE SimdVector<T> multiply_add_rows(SimdVector<T, p> a, SimdVector<T, q> b, SimdVector<T> c) {
  TALUS_UNROLL for (int r = 0; r < (p > q ? p : q); ++r) {
    c.row[0] = registers::fused(a.row[r % p], b.row[r % q], c.row[0]);
  }
  return c;
}

template <class T, int p, int q>
TALUS_INLINE SimdMask<T, (p > q ? p : q)> operator>(SimdVector<T, p> a, SimdVector<T, q> b) {
  SimdMask<T, (p > q ? p : q)> mask;
  TALUS_UNROLL for (int r = 0; r < (p > q ? p : q); ++r) mask.row[r] = registers::greater(a.row[r % p], b.row[r % q]);
  return mask;
}

template <class T, int p, int q>
TALUS_INLINE SimdMask<T, (p > q ? p : q)> operator<(SimdVector<T, p> a, SimdVector<T, q> b) {
  return b > a;
}
template <class T, int rows>
TALUS_INLINE SimdMask<T, rows> operator&&(SimdMask<T, rows> a, SimdMask<T, rows> b) {
  for (int r = 0; r < rows; ++r) a.row[r] = static_cast<typename registers::Of<T>::Mask>(a.row[r] & b.row[r]);
  return a;
}
template <class T, int rows>
TALUS_INLINE SimdMask<T, rows> operator||(SimdMask<T, rows> a, SimdMask<T, rows> b) {
  for (int r = 0; r < rows; ++r) a.row[r] = static_cast<typename registers::Of<T>::Mask>(a.row[r] | b.row[r]);
  return a;
}

/// Lane by lane, `yes` where the condition holds and `no` elsewhere; the other value may be anything.
template <class T, int rows, int p, int q>
TALUS_INLINE SimdVector<T, rows> select(SimdMask<T, rows> condition, SimdVector<T, p> yes, SimdVector<T, q> no) {
  SimdVector<T, rows> x;
  TALUS_UNROLL for (int r = 0; r < rows; ++r) {
    x.row[r] = registers::blend(condition.row[r], yes.row[r % p], no.row[r % q]);
  }
  return x;
}

template <class T, int p, int q>
TALUS_INLINE auto minimum(SimdVector<T, p> a, SimdVector<T, q> b) {
  return select(a > b, b, a);
}
template <class T, int p, int q>
TALUS_INLINE auto maximum(SimdVector<T, p> a, SimdVector<T, q> b) {
  return select(a > b, a, b);
}

/// f(number) of every number of x, one after the other: for what has no vector form.
template <class T, int rows, class Function>
TALUS_INLINE SimdVector<T, rows> map_lanes(SimdVector<T, rows> x, Function&& f) {
  for (int r = 0; r < rows; ++r)
    for (int k = 0; k < SimdVector<T>::lanes; ++k) x.row[r][k] = static_cast<T>(f(x.row[r][k]));
  return x;
}
template <class T, int rows>
TALUS_INLINE SimdVector<T, rows> sqrt(SimdVector<T, rows> x) {
  TALUS_UNROLL for (int r = 0; r < rows; ++r) x.row[r] = registers::square_root(x.row[r]);
  return x;
}
template <class T, int rows>
TALUS_INLINE SimdVector<T, rows> log(SimdVector<T, rows> x) {
  return map_lanes(x, [](T number) { return std::log(number); });
}

/// As gather_rows of a scalar.
template <int count, class T, int rows, class RowOf>
TALUS_INLINE void gather_rows(SimdVector<T, rows> x, RowOf&& row_of, SimdVector<T, rows> (&values)[count]) {
  for (int r = 0; r < rows; ++r) {
    alignas(registers::bytes) T lane[count][SimdVector<T>::lanes];
    for (int k = 0; k < SimdVector<T>::lanes; ++k) {
      const auto* row = row_of(x.row[r][k]);
      for (int c = 0; c < count; ++c) lane[c][k] = static_cast<T>(row[c]);
    }
    for (int c = 0; c < count; ++c) values[c].row[r] = SimdVector<T>::load(lane[c]).row[0];
  }
}

/// Whether the condition holds in every lane.
template <class T, int rows>
TALUS_INLINE bool all(SimdMask<T, rows> condition) {
  auto together = condition.row[0];
  TALUS_UNROLL for (int r = 1; r < rows; ++r) together &= condition.row[r];
  return registers::all(together);
}

/// A bit for each lane, the first one lowest: whether the condition holds there.
template <class T>
TALUS_INLINE unsigned lane_bits(SimdMask<T, 1> condition) {
  return registers::bits(condition.row[0]);
}

/// Writes the lanes where the condition holds one after the other. \param packed `lanes` numbers, of which those behind
/// the ones that were written may change
template <class T>
TALUS_INLINE void store_packed(SimdVector<T> x, SimdMask<T, 1> condition, T* packed) {
  registers::pack(x.row[0], condition.row[0], packed);
}

/// 1/sqrt(x): the processor's estimate y, and with e = 1 - x y^2 as many terms of y (1 + e/2 + 3/8 e^2 + 5/16 e^3 ...)
/// as the type can hold. Measured relative error: 1.7e-16 and 9e-8, three quarters of the type's epsilon. Not finite at
/// x = 0. With avx2 doubles start from a float: beyond its range, 1e-38 to 3e38, the result is 0 or not finite.
template <class T, int rows>
TALUS_INLINE SimdVector<T, rows> reciprocal_sqrt(SimdVector<T, rows> x) {
  using Number = SimdVector<T>;
  SimdVector<T, rows> y;
  TALUS_UNROLL for (int r = 0; r < rows; ++r) y.row[r] = registers::estimate_reciprocal_sqrt(x.row[r]);
  constexpr int bits = sizeof(T) == 8 ? 53 : 24;
  if constexpr (registers::estimate_bits >= bits) {
    return y;
  } else {
    const SimdVector<T, rows> e = negative_multiply_add(x * y, y, Number(1));
    const SimdVector<T, rows> ye = y * e;
    if constexpr (2 * registers::estimate_bits >= bits) {
      return multiply_add(ye, Number(0.5), y);
    } else if constexpr (3 * registers::estimate_bits >= bits) {
      return multiply_add(ye, multiply_add(e, Number(3.0 / 8), Number(0.5)), y);
    } else if constexpr (4 * registers::estimate_bits >= bits) {
      const auto series = multiply_add(e, multiply_add(e, Number(5.0 / 16), Number(3.0 / 8)), Number(0.5));
      return multiply_add(ye, series, y);
    } else {
      const auto tail = multiply_add(e, multiply_add(e, Number(35.0 / 128), Number(5.0 / 16)), Number(3.0 / 8));
      return multiply_add(ye, multiply_add(e, tail, Number(0.5)), y);
    }
  }
}

/// Sum of the lanes of row r, in a fixed order.
template <class T, int rows>
TALUS_INLINE T sum_lanes(SimdVector<T, rows> x, int r) {
  return registers::sum(x.row[r]);
}

}  // namespace TALUS_INSTRUCTION_SET
}  // namespace talus
