// SPDX-License-Identifier: Apache-2.0
/// The exponential function without branches or calls, so that the compiler vectorises loops that contain it.
#pragma once

#include <bit>
#include <cstdint>

#include "base/registers.hpp"

namespace talus {

/// exp(-x) for x >= -700, relative error below 4e-16; from x = 700 on exp(-700), 1e-304. With x = n log 2 + r, |r| <=
/// log(2)/2, it is 2^-n times the series of exp(-r) to r^13/13! (the next term is below 5e-18).
TALUS_INLINE double exp_of_negative(double x) {
  constexpr double rounding = 0x1.8p52;  // to add and subtract it rounds to a whole number, in the lowest bits
  constexpr double log2_e = 0x1.71547652b82fep0, log_2_high = 0x1.62e42fefa38p-1, log_2_low = 0x1.ef35793c7673p-45;
  const double most = x < 700 ? x : 700;
  const double shifted = most * log2_e + rounding, n = shifted - rounding;
  const double r = (n * log_2_high - most) + n * log_2_low;
  double sum = 1.0 / 6227020800;
  sum = sum * r + 1.0 / 479001600;
  sum = sum * r + 1.0 / 39916800;
  sum = sum * r + 1.0 / 3628800;
  sum = sum * r + 1.0 / 362880;
  sum = sum * r + 1.0 / 40320;
  sum = sum * r + 1.0 / 5040;
  sum = sum * r + 1.0 / 720;
  sum = sum * r + 1.0 / 120;
  sum = sum * r + 1.0 / 24;
  sum = sum * r + 1.0 / 6;
  sum = sum * r + 1.0 / 2;
  sum = sum * r + 1.0 / 1;
  sum = sum * r + 1;
  const std::uint64_t exponent =
      1023 - (std::bit_cast<std::uint64_t>(shifted) - std::bit_cast<std::uint64_t>(rounding));
  return sum * std::bit_cast<double>(exponent << 52);
}

/// (1 - exp(-x))/x for 0 <= x <= 1/2, 1 at 0: its series to x^14/15! (the next term is below 1e-18).
TALUS_INLINE double mean_of_short_decay(double x) {
  double sum = 1.0 / 1307674368000;
  sum = 1.0 / 87178291200 - x * sum;
  sum = 1.0 / 6227020800 - x * sum;
  sum = 1.0 / 479001600 - x * sum;
  sum = 1.0 / 39916800 - x * sum;
  sum = 1.0 / 3628800 - x * sum;
  sum = 1.0 / 362880 - x * sum;
  sum = 1.0 / 40320 - x * sum;
  sum = 1.0 / 5040 - x * sum;
  sum = 1.0 / 720 - x * sum;
  sum = 1.0 / 120 - x * sum;
  sum = 1.0 / 24 - x * sum;
  sum = 1.0 / 6 - x * sum;
  sum = 1.0 / 2 - x * sum;
  return 1 - x * sum;
}

}  // namespace talus
