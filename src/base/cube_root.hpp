// SPDX-License-Identifier: Apache-2.0
/// The cube root without calls, for loops over many numbers.
#pragma once

#include <cmath>
#include <cstdint>

namespace talus {

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
