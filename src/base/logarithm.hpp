// SPDX-License-Identifier: Apache-2.0
/// The natural logarithm of what is mostly near 1, bitwise identical for numbers and for vectors of them.
#pragma once

#include <cmath>

#include "base/simd.hpp"

namespace talus {

/// log(x), x > 0: between 0.8 and 1.25 twice the series of atanh(s) with s = (x - 1)/(x + 1) to s^17/17 (the next term
/// is below 1e-18 of it), beyond the library's.
template <class Number>
TALUS_INLINE Number log_near_one(Number x) {
  const Number s = (x - 1.0) / (x + 1.0), t = s * s;
  constexpr double terms[] = {1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3};
  Number sum = 1.0 / 17;
  for (const double term : terms) sum = sum * t + term;
  const Number near = 2.0 * (s + s * (t * sum));
  const auto within = x > Number(0.8) && x < Number(1.25);
  if (all(within)) return near;
  return select(within, near, map_lanes(x, [](auto number) { return std::log(number); }));
}

}  // namespace talus
