// SPDX-License-Identifier: Apache-2.0
/// The cubic spline kernel in three dimensions, with support 2 h.
/// Source: Monaghan, Annu. Rev. Astron. Astrophys. 30, 543-574 (1992), section 2.2; Yuu & Umekage 2011, below Eq. 16.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/elementary.hpp"
#include "base/simd.hpp"

namespace talus::sph {

/// Support over smoothing length: pairs farther apart do not interact.
inline constexpr double support = 2;

/// Smoothing length of a particle, h = (m/rho_b)^(1/3): the distance between particles. Yuu & Umekage 2011, below
/// Eq. 16. \param mass kg; \param density bulk density, kg/m^3; \returns m
inline double smoothing_length(double mass, double density) {
  return cube_root(mass / density);
}

/// 4 pi h^3 W(r, h) from 2 - q and 1 - q, q = r/h, or 0 where they are negative.
template <class Number>
TALUS_INLINE Number cubic_spline_shape(Number outer, Number inner) {
  return outer * outer * outer - 4 * (inner * inner * inner);
}

/// The same from q = r/h.
template <class Number>
TALUS_INLINE Number cubic_spline_shape_of(Number q) {
  const Number zero = 0.0;
  return cubic_spline_shape(select(Number(2.0) > q, Number(2.0) - q, zero),
                            select(Number(1.0) > q, Number(1.0) - q, zero));
}

/// W(r, h) from q = r/h and 1/h. \returns 1/m^3
template <class Number>
TALUS_INLINE Number cubic_spline_of(Number q, Number inverse_h) {
  return 1.0 / (4 * std::numbers::pi) * (inverse_h * inverse_h * inverse_h) * cubic_spline_shape_of(q);
}

/// F(r, h) from q = r/h, 1/q and 1/h; 1/q may be anything where q = 0. \returns 1/m^5
template <class Number>
TALUS_INLINE Number cubic_spline_slope_of(Number q, Number inverse_q, Number inverse_h) {
  const Number outer = select(Number(2.0) > q, Number(2.0) - q, Number(0.0));
  // ((2-q)^2 - 4 (1-q)^2)/q is 4 - 3 q within q < 1.
  const Number shape = select(q > Number(1.0), outer * outer * inverse_q, 4.0 - 3.0 * q);
  const Number h2 = inverse_h * inverse_h;
  return -3.0 / (4 * std::numbers::pi) * (h2 * h2 * inverse_h) * shape;
}

/// W(r, h) = ((2-q)^3 - 4 (1-q)^3)/(4 pi h^3) with q = r/h, each cube counted where its base is positive.
/// \param distance r, m; \param h smoothing length, m; \returns 1/m^3
template <class Number>
TALUS_INLINE Number cubic_spline(Number distance, Number h) {
  const Number inverse_h = 1.0 / h;
  return cubic_spline_of(distance * inverse_h, inverse_h);
}

/// F(r, h) = (dW/dr)/r <= 0, so that the gradient of W at x_i is F (x_i - x_j). Finite at r = 0.
/// \param distance r, m; \param h smoothing length, m; \returns 1/m^5
template <class Number>
TALUS_INLINE Number cubic_spline_slope(Number distance, Number h) {
  const Number inverse_h = 1.0 / h;
  return cubic_spline_slope_of(distance * inverse_h, h / distance, inverse_h);
}

/// The kernel integrated over a plane: 2 pi times the integral of W r from the distance on; its integral along the
/// normal is 1. \param distance from the plane, \param h smoothing length, m; \returns 1/m
inline double cubic_spline_plane(double distance, double h) {
  const auto part = [q = distance / h](double a) {
    const double u = a > q ? a - q : 0;
    return u * u * u * u * (0.25 * a - 0.2 * u);
  };
  return (part(2) - 4 * part(1)) / (2 * h);
}

// The cubic spline kernel integrated along a straight line: the kernel of a particle in a section averaged along its
// normal.

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

/// Bitwise ratio * smoothing_length(mass, density) of each, in vectors. \param mass kg; \param density kg/m^3;
/// \param length m
void smoothing_lengths(std::size_t count, double mass, double ratio, const double* density, double* length);

}  // namespace talus::sph
