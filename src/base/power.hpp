// SPDX-License-Identifier: Apache-2.0
/// Powers without branches or calls, so that the compiler vectorises loops that contain them.
#pragma once

#include <bit>
#include <cstdint>

#include "base/exponential.hpp"

namespace talus {

/// log(x) of a normal x > 0, absolute error below 3e-16 max(1, |log x|); about -709 for 0 and subnormal numbers. With
/// x = 2^n m, m between the square roots of 1/2 and 2, it is n log 2 and twice the series of atanh(s), s = (m - 1)/(m +
/// 1), to s^21/21 (the next term is below 2e-19).
TALUS_INLINE double log_of(double x) {
  constexpr std::uint64_t one = std::bit_cast<std::uint64_t>(1.0), root = 0x3fe6a09e667f3bcd;  // of 1/2
  constexpr double whole = 0x1p52;  // numbers of this binade have their whole part in the lowest bits
  constexpr double log_2_high = 0x1.62e42fefa38p-1, log_2_low = 0x1.ef35793c7673p-45;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t biased = (bits + (one - root)) >> 52;  // n + 1023
  const double n = std::bit_cast<double>(biased | std::bit_cast<std::uint64_t>(whole)) - (whole + 1023);
  const double m = std::bit_cast<double>(bits - (biased << 52) + one);
  const double s = (m - 1) / (m + 1), t = s * s;
  double sum = 2.0 / 21;
  sum = sum * t + 2.0 / 19;
  sum = sum * t + 2.0 / 17;
  sum = sum * t + 2.0 / 15;
  sum = sum * t + 2.0 / 13;
  sum = sum * t + 2.0 / 11;
  sum = sum * t + 2.0 / 9;
  sum = sum * t + 2.0 / 7;
  sum = sum * t + 2.0 / 5;
  sum = sum * t + 2.0 / 3;
  return n * log_2_high + (2 * s + (s * (t * sum) + n * log_2_low));
}

/// x^p for x >= 0 and |p log x| <= 700, relative error below 4e-16 (1 + |p log x|); of 0, exp(-709 p).
TALUS_INLINE double power_of(double x, double p) {
  return exp_of_negative(-p * log_of(x));
}

}  // namespace talus
