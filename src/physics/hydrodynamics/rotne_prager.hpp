// SPDX-License-Identifier: Apache-2.0
/// How a sphere that a force drags through a viscous fluid carries another one along: the Rotne-Prager tensor, as the
/// avalanche paper prints it. Unbounded fluid, Reynolds number far below 1, no rotation.
/// Source: Rotne & Prager, J. Chem. Phys. 50, 4831 (1969); Niiya, Awazu & Nishimori 2020, Eqs 3b and 3c.
#pragma once

#include "base/simd.hpp"

namespace talus::hydrodynamics {

/// Velocity of one sphere over the force on another, times 8 pi mu:  isotropic I + radial d d^T,  d = x_i - x_j.
template <class Number>
struct PairMobility {
  Number isotropic;  ///< 1/m
  Number radial;     ///< 1/m^3
};

/// Point force and the first correction for the spheres' size:
///     [I + dd/r^2]/r + s [I - 3 dd/r^2]/r^3.
/// \param inverse_distance 1/r, 1/m; at r = 0 the result is not finite
/// \param finite_size s, m^2
template <class Number, class Size>
constexpr PairMobility<Number> oseen_with_size(const Number& inverse_distance, const Size& finite_size) {
  const Number inverse_square = inverse_distance * inverse_distance;
  const Number inverse_cube = inverse_distance * inverse_square;
  return {multiply_add(finite_size, inverse_cube, inverse_distance),
          negative_multiply_add(3.0 * finite_size, inverse_cube * inverse_square, inverse_cube)};
}

/// s of Eq. 3c: two thirds of the square of the radius of the sphere that the force acts on. \param radius m
template <class Number>
constexpr Number source_size(const Number& radius) {
  return (2.0 / 3.0) * (radius * radius);
}

/// Eq. 3c. Exact to the order (a/r)^3 for two equal spheres apart, r > 2a.
/// deviates: not from the print, but the print from Rotne & Prager, who have a_i^2 + a_j^2 in place of 2 a_j^2: with
/// unequal radii the mobility is not symmetric. It is used for overlapping spheres too, where it does not hold; the
/// velocity grows without bound as r goes to 0.
/// \param source_size of sphere j, the one that the force acts on
template <class Number, class Size>
constexpr PairMobility<Number> rotne_prager_1969(const Number& inverse_distance, const Size& source_size) {
  return oseen_with_size(inverse_distance, source_size);
}

}  // namespace talus::hydrodynamics
