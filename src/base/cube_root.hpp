// SPDX-License-Identifier: Apache-2.0
/// The cube root without calls, for loops over many numbers.
#pragma once

#include <cmath>
#include <cstdint>

namespace talus {

/// x^(1/3) of a normal x > 0, relative error below 4e-16; of others the library's. A third of the bits, exponent and
/// all, is within 4 % of it; three steps of Halley's method, each of which cubes the error, do the rest.
inline double cube_root(double x) {
  if (!(x >= 0x1p-1022 && x <= 0x1.fffffffffffffp1023)) return std::cbrt(x);
  // A third of the exponent's bias is lacking after the division: two thirds of 1023 * 2^52, less what centres the
  // error.
  constexpr std::uint64_t lacking = 0x2a9f7893ull << 32;
  double y = __builtin_bit_cast(double, __builtin_bit_cast(std::uint64_t, x) / 3 + lacking);
  for (int step = 0; step < 3; ++step) {
    const double cubed = y * y * y;
    y -= y * ((cubed - x) / (2 * cubed + x));
  }
  return y;
}

}  // namespace talus
