// SPDX-License-Identifier: Apache-2.0
/// Elementary functions without branches or calls, so that the compiler vectorises loops that contain them.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/simd.hpp"

namespace talus {

/// Horner's scheme. \param first, others coefficients, that of the highest power first
template <class Number, class... Others>
TALUS_INLINE Number polynomial(const Number& x, double first, Others... others) {
  Number sum = first;
  ((sum = sum * x + others), ...);
  return sum;
}

/// exp(-x) for x >= -700, relative error below 4e-16; from x = 700 on exp(-700), 1e-304. With x = n log 2 + r, |r| <=
/// log(2)/2, it is 2^-n times the series of exp(-r) to r^13/13! (the next term is below 5e-18).
TALUS_INLINE double exp_of_negative(double x) {
  constexpr double rounding = 0x1.8p52;  // to add and subtract it rounds to a whole number, in the lowest bits
  constexpr double log2_e = 0x1.71547652b82fep0, log_2_high = 0x1.62e42fefa38p-1, log_2_low = 0x1.ef35793c7673p-45;
  const double most = x < 700 ? x : 700;
  const double shifted = most * log2_e + rounding, n = shifted - rounding;
  const double r = (n * log_2_high - most) + n * log_2_low;
  const double sum = polynomial(r, 1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880,
                                1.0 / 40320, 1.0 / 5040, 1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6, 1.0 / 2, 1.0, 1.0);
  const std::uint64_t exponent =
      1023 - (__builtin_bit_cast(std::uint64_t, shifted) - __builtin_bit_cast(std::uint64_t, rounding));
  return sum * __builtin_bit_cast(double, exponent << 52);
}

/// (1 - exp(-x))/x for 0 <= x <= 1/2, 1 at 0: its series to x^14/15! (the next term is below 1e-18).
TALUS_INLINE double mean_of_short_decay(double x) {
  return polynomial(-x, 1.0 / 1307674368000, 1.0 / 87178291200, 1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800,
                    1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040, 1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6,
                    1.0 / 2, 1.0);
}

/// log(x) of a normal x > 0, absolute error below 3e-16 max(1, |log x|); about -709 for 0 and subnormal numbers. With
/// x = 2^n m, m between the square roots of 1/2 and 2, it is n log 2 and twice the series of atanh(s), s = (m - 1)/(m +
/// 1), to s^21/21 (the next term is below 2e-19).
TALUS_INLINE double log_of(double x) {
  constexpr std::uint64_t one = __builtin_bit_cast(std::uint64_t, 1.0), root = 0x3fe6a09e667f3bcd;  // of 1/2
  constexpr double whole = 0x1p52;  // numbers of this binade have their whole part in the lowest bits
  constexpr double log_2_high = 0x1.62e42fefa38p-1, log_2_low = 0x1.ef35793c7673p-45;
  const auto bits = __builtin_bit_cast(std::uint64_t, x);
  const std::uint64_t biased = (bits + (one - root)) >> 52;  // n + 1023
  const double n = __builtin_bit_cast(double, biased | __builtin_bit_cast(std::uint64_t, whole)) - (whole + 1023);
  const double m = __builtin_bit_cast(double, bits - (biased << 52) + one);
  const double s = (m - 1) / (m + 1), t = s * s;
  const double sum =
      polynomial(t, 2.0 / 21, 2.0 / 19, 2.0 / 17, 2.0 / 15, 2.0 / 13, 2.0 / 11, 2.0 / 9, 2.0 / 7, 2.0 / 5, 2.0 / 3);
  return n * log_2_high + (2 * s + (s * (t * sum) + n * log_2_low));
}

/// x^p for x >= 0 and |p log x| <= 700, relative error below 4e-16 (1 + |p log x|); of 0, exp(-709 p).
TALUS_INLINE double power_of(double x, double p) {
  return exp_of_negative(-p * log_of(x));
}

/// log(x), x > 0, of what is mostly near 1, bitwise identical for numbers and for vectors: between 0.8 and 1.25 twice
/// the series of atanh(s) with s = (x - 1)/(x + 1) to s^17/17 (the next term is below 1e-18 of it), beyond the
/// library's.
template <class Number>
TALUS_INLINE Number log_near_one(Number x) {
  const Number s = (x - 1.0) / (x + 1.0), t = s * s;
  const Number sum = polynomial(t, 1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3);
  const Number near = 2.0 * (s + s * (t * sum));
  const auto within = x > Number(0.8) && x < Number(1.25);
  if (all(within)) return near;
  return select(within, near, map_lanes(x, [](auto number) { return std::log(number); }));
}

constexpr bool is_normal_and_positive(double x) {
  return (x >= 0x1p-1022) & (x <= 0x1.fffffffffffffp1023);  // without a branch, for vectors
}

/// bits/3, from products of halves, which vectors have.
constexpr std::uint64_t third_of(std::uint64_t bits) {
  constexpr std::uint64_t inverse = 0xaaaaaaab;  // (2^33 + 1)/3
  const std::uint64_t high = bits >> 32, low = bits & 0xffffffff;
  const std::uint64_t high_third = high * inverse >> 33, low_third = low * inverse >> 33;
  // What is left of the high half counts 2^32 = 3 * 0x55555555 + 1 times.
  const std::uint64_t high_left = high - 3 * high_third, low_left = low - 3 * low_third;
  return (high_third << 32) + high_left * 0x55555555 + low_third + (high_left + low_left >= 3 ? 1 : 0);
}

/// x^(1/3) of a normal x > 0, relative error below 4e-16. A third of the bits, exponent and all, is within 4 % of it;
/// three steps of Halley's method, each of which cubes the error, do the rest.
inline double normal_cube_root(double x) {
  // A third of the exponent's bias is lacking after the division: two thirds of 1023 * 2^52, less what centres the
  // error.
  constexpr std::uint64_t lacking = 0x2a9f7893ull << 32;
  double y = __builtin_bit_cast(double, third_of(__builtin_bit_cast(std::uint64_t, x)) + lacking);
  for (int step = 0; step < 3; ++step) {
    const double cubed = y * y * y;
    y -= y * ((cubed - x) / (2 * cubed + x));
  }
  return y;
}

/// x^(1/3): as above; of others the library's.
inline double cube_root(double x) {
  return is_normal_and_positive(x) ? normal_cube_root(x) : std::cbrt(x);
}

}  // namespace talus
