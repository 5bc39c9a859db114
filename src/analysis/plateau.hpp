// SPDX-License-Identifier: Apache-2.0
/// Where a rate is steady: found from the curve itself.
#pragma once

#include <limits>

#include "analysis/curve.hpp"

namespace talus {

struct Plateau {
  double from = none, to = none;  ///< its ends
  double value = none;            ///< mean rate between them
  double error = none;            ///< of that, two standard errors

  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
};

/// The longest stretch of consecutive means over `length`, five at least, that all lie within `spread` of their own
/// mean (relative); of several as long the first. A stretch does not begin before the rate has come to half of the
/// largest mean, so that a rest is no plateau. Nan where there is none.
///
/// The error: the standard deviation of the means over the root of their number, times 2; where neighbours are alike
/// (r, the correlation of each with the next, above 0) only (1 - r)/(1 + r) of them count, and two at least. \param
/// cumulative the integral of the rate \param length of a mean
Plateau find_plateau(const Curve& cumulative, double length, double spread, double from, double to);

}  // namespace talus
