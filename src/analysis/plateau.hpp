// SPDX-License-Identifier: Apache-2.0
/// Where a rate is steady: found from the curve itself.
#pragma once

#include <limits>
#include <span>

#include "analysis/curve.hpp"

namespace talus {

struct Plateau {
  double from = none, to = none;  ///< its ends
  double value = none;            ///< mean rate between them
  double error = none;            ///< half width of its 95 % interval; nan where the stretch is too short for one

  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
};

/// The longest stretch of consecutive means over `length`, five at least, that all lie within `spread` of their own
/// mean (relative); of several as long the first. A stretch does not begin before the rate has come to half of the
/// largest mean, so that a rest is no plateau. Nan where there is none.
///
/// The error is error_of_blocks(). \param cumulative the integral of the rate \param length of a mean
Plateau find_plateau(const Curve& cumulative, double length, double spread, double from, double to);

/// Half width of the 95 % interval of the mean rate over from..to, from the means of five to ten blocks of equal
/// length: Student's t times their standard error. A block is at least as long as `length`, and as three correlation
/// times of the means over a quarter of it, so that blocks are independent; nan where there is no room for five.
/// Source: Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461 (blocks); Sokal, Monte Carlo Methods (1997) (length)
double error_of_blocks(const Curve& cumulative, double length, double from, double to);

/// Integrated correlation time of equally spaced values, in their spacing: 1 + 2 sum of the correlations up to the
/// first that is not positive; 1 for independent ones.
double correlation_time(std::span<const double> values);

}  // namespace talus
