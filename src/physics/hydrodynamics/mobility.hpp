// SPDX-License-Identifier: Apache-2.0
/// How a sphere that a force drags through a viscous fluid carries another one along. Unbounded fluid, Reynolds number
/// far below 1, no rotation. Sources: the Rotne-Prager tensor as the avalanche paper prints it: Rotne & Prager, J.
/// Chem. Phys. 50, 4831 (1969); Niiya, Awazu & Nishimori 2020, Eqs 3b and 3c. Completed for spheres of unequal radii
/// that may overlap or lie within each other, symmetric, continuous and positive definite for every configuration: Zuk,
/// Wajnryb, Mizerski & Szymczak, J. Fluid Mech. 741, R5 (2014).
#pragma once

#include "base/simd.hpp"

namespace talus::hydrodynamics {

enum class Mobility {
  rotne_prager_1969,  ///< as Niiya et al. 2020 print it, with the source's radius alone
  zuk_2014,           ///< symmetric and positive definite for unequal and overlapping spheres
  none                ///< no interaction through the fluid: each sphere has its own Stokes drag (stokes.hpp)
};

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

/// One sphere's share in the finite size of a pair apart, (a_i^2 + a_j^2)/3. \param radius m; \returns m^2
template <class Number>
constexpr Number shared_size(const Number& radius) {
  return (1.0 / 3.0) * (radius * radius);
}

/// Whether the spheres are apart, r > a_i + a_j. \param square r^2, m^2; \param a_i, a_j radii, m
template <class Number, class RadiusI, class RadiusJ>
constexpr auto are_apart(const Number& square, const RadiusI& a_i, const RadiusJ& a_j) {
  const auto reach = a_i + a_j;
  return square > reach * reach;
}

/// Spheres apart. \param inverse_distance 1/r, 1/m; \param size_i, size_j the spheres' `shared_size`, m^2
template <class Number, class SizeI, class SizeJ>
constexpr PairMobility<Number> zuk_2014_apart(const Number& inverse_distance, const SizeI& size_i,
                                              const SizeJ& size_j) {
  return oseen_with_size(inverse_distance, size_i + size_j);
}

/// Spheres that overlap. With D = a_i - a_j and q = (D/r)^2:
///     |D| < r:   4/(3 a_i a_j) { [(a_i + a_j)/2 - r (3 + q)^2/32] I + [3 r (1 - q)^2/32] d d^T/r^2 }
///     r <= |D|:  4/(3 max(a_i, a_j)) I
/// Centres nearer than 1e-15 of the radii count as one position, where q would not be a number.
/// \param square r^2, m^2; \param inverse_distance 1/r, 1/m, anything where r = 0; \param a_i, a_j radii, m
template <class Number, class RadiusI, class RadiusJ>
constexpr PairMobility<Number> zuk_2014_overlapping(const Number& square, const Number& inverse_distance,
                                                    const RadiusI& a_i, const RadiusJ& a_j) {
  const auto difference = a_i - a_j;
  const auto difference_square = difference * difference;
  const auto product = a_i * a_j;
  const auto scale = (4.0 / 3.0) / product;
  const Number distance = square * inverse_distance;
  const Number q = difference_square * (inverse_distance * inverse_distance);
  const Number isotropic = scale * (0.5 * (a_i + a_j) - (1.0 / 32.0) * (distance * ((3.0 + q) * (3.0 + q))));
  const Number radial = scale * ((3.0 / 32.0) * (inverse_distance * ((1.0 - q) * (1.0 - q))));

  const auto nothing = 1e-30 * product;
  const auto within = select(difference_square > nothing, difference_square, nothing);
  const auto larger = select(difference > 0.0 * difference, a_i, a_j);
  const auto crosses = square > within;
  return {select(crosses, isotropic, (4.0 / 3.0) / larger), select(crosses, radial, 0.0 * larger)};
}

/// The law for every distance. \param as `zuk_2014_overlapping`
template <class Number, class RadiusI, class RadiusJ>
constexpr PairMobility<Number> zuk_2014(const Number& square, const Number& inverse_distance, const RadiusI& a_i,
                                        const RadiusJ& a_j) {
  const auto apart = are_apart(square, a_i, a_j);
  const auto far = zuk_2014_apart(inverse_distance, shared_size(a_i), shared_size(a_j));
  const auto near = zuk_2014_overlapping(square, inverse_distance, a_i, a_j);
  return {select(apart, far.isotropic, near.isotropic), select(apart, far.radial, near.radial)};
}

}  // namespace talus::hydrodynamics
