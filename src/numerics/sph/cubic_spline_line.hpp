// SPDX-License-Identifier: Apache-2.0
/// The cubic spline kernel integrated along a straight line: the kernel of a particle in a section averaged along its
/// normal.
#pragma once

#include <cmath>
#include <numbers>

namespace talus::sph {

namespace detail {

/// Integral of (a - r)^3 over the chord of the sphere r < a at distance s from its centre, half of it.
inline double cubed_depth_of_chord(double a, double s) {
  if (!(s < a)) return 0;
  const double y = std::sqrt((a - s) * (a + s)), s2 = s * s;
  const double area = s > 0 ? s2 * std::log((y + a) / s) : 0;     // s^2 asinh(y/s), 0 in the middle
  const double first = 0.5 * (y * a + area);                      // integral of r
  const double second = s2 * y + y * y * y / 3;                   // of r^2
  const double third = 0.25 * y * a * a * a + 0.75 * s2 * first;  // of r^3
  return a * a * a * y - 3 * a * a * first + 3 * a * second - third;
}

}  // namespace detail

/// Integral of cubic_spline along the line at distance `distance` from the particle's centre. Its integral over a plane
/// is 1. \param distance m; \param h smoothing length, m; \returns 1/m^2
inline double cubic_spline_line(double distance, double h) {
  const double s = distance / h;
  return (detail::cubed_depth_of_chord(2, s) - 4 * detail::cubed_depth_of_chord(1, s)) / (2 * std::numbers::pi * h * h);
}

}  // namespace talus::sph
