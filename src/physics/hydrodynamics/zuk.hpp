// SPDX-License-Identifier: Apache-2.0
/// The Rotne-Prager mobility completed for spheres of unequal radii that may overlap or lie within each other:
/// symmetric, continuous, and positive definite for every configuration. Unbounded fluid, Reynolds number far below 1,
/// no rotation. As PairMobility says, times 8 pi mu; d = x_i - x_j.
/// Source: Zuk, Wajnryb, Mizerski & Szymczak, J. Fluid Mech. 741, R5 (2014); for equal radii Rotne & Prager 1969.
#pragma once

#include "physics/hydrodynamics/rotne_prager.hpp"

namespace talus::hydrodynamics {

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
/// Centres nearer than 1e-15 of the radii count as one place, where q would not be a number.
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
