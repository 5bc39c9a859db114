// SPDX-License-Identifier: Apache-2.0
/// Numbers that change with time: a curve, and what is read off it.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace talus {

/// In place of a number that a run does not have: nan.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Values at increasing times, one per time. The unit of time is the caller's: s, or a/v_s for a curve of an ensemble.
struct Curve {
  std::vector<double> time;
  std::vector<double> value;
};

/// The part with from < t <= to; times that differ from a bound by less than 1e-9 of it count as equal to it.
Curve part(const Curve& curve, double from, double to);

/// Value at time t, linear between the curve's points.
/// \throws std::invalid_argument if t is outside the curve
double value_at(const Curve& curve, double t);

/// The point nearest t; of two equally near the earlier. \throws std::invalid_argument for an empty curve
std::size_t nearest_point(std::span<const double> time, double t);

/// Minimum, maximum, and the time of the maximum (the first of equal ones); nan if a value is nan.
/// \throws std::invalid_argument for an empty curve
struct Extremes {
  double min, max, max_time;
};
Extremes extremes(const Curve& curve);

/// The first time at which the curve, linear between its points, is at or below the level; nan if it never is.
double first_time_at_or_below(const Curve& curve, double level);

}  // namespace talus
