// SPDX-License-Identifier: Apache-2.0
/// The Rotne-Prager mobility completed for spheres of unequal radii that may overlap or lie within each other:
/// symmetric, continuous, positive definite for every configuration.
/// Source: Zuk, Wajnryb, Mizerski & Szymczak, J. Fluid Mech. 741, R5 (2014); for equal radii Rotne & Prager 1969.
#pragma once

#include "physics/hydrodynamics/rotne_prager.hpp"

namespace talus::hydrodynamics {

/// The spheres' share in s of `oseen_with_size`: s = (a_i^2 + a_j^2)/3 is the sum of both. \param radius m
template <class Number>
constexpr Number shared_size(const Number& radius) {
  return (1.0 / 3.0) * (radius * radius);
}

/// Spheres apart, r > a_i + a_j.
template <class Number, class SizeI, class SizeJ>
constexpr PairMobility<Number> zuk_2014_apart(const Number& inverse_distance, const SizeI& shared_size_i,
                                              const SizeJ& shared_size_j) {
  return oseen_with_size(inverse_distance, shared_size_i + shared_size_j);
}

/// Spheres that overlap, r <= a_i + a_j; times 8 pi mu and so 4/3 of the paper's factors of 1/(6 pi mu). With
/// D = a_i - a_j and q = (D/r)^2:
///     |D| < r:   4/(3 a_i a_j) { [(a_i + a_j)/2 - r (3 + q)^2/32] I + [3 r (1 - q)^2/32] dd/r^2 }
///     r <= |D|:  4/(3 max(a_i, a_j)) I
/// Spheres whose squared distance is below 1e-30 of a_i a_j count as concentric: at r = 0 q would not be a number.
/// \param square r^2, m^2; \param inverse_distance 1/r, 1/m, anything where r = 0; \param a_i, a_j radii, m
template <class Number, class RadiusI, class RadiusJ>
constexpr PairMobility<Number> zuk_2014_overlapping(const Number& square, const Number& inverse_distance,
                                                    const RadiusI& a_i, const RadiusJ& a_j) {
  const auto difference = a_i - a_j;
  const auto difference_square = difference * difference;
  const auto product = a_i * a_j;
  const Number distance = square * inverse_distance;
  const Number q = difference_square * (inverse_distance * inverse_distance);
  const auto scale = (4.0 / 3.0) / product;
  const Number isotropic = scale * (0.5 * (a_i + a_j) - (1.0 / 32.0) * (distance * ((q + 3.0) * (q + 3.0))));
  const Number radial = scale * ((3.0 / 32.0) * (inverse_distance * ((1.0 - q) * (1.0 - q))));
  const auto larger = select(a_i > a_j, a_i, a_j);
  const Number zero = 0.0;
  const auto apart_centres = square > select(difference_square > 1e-30 * product, difference_square, 1e-30 * product);
  return {select(apart_centres, isotropic, (4.0 / 3.0) / larger + zero), select(apart_centres, radial, zero)};
}

/// The law for every distance. \param as above
template <class Number, class RadiusI, class RadiusJ>
constexpr PairMobility<Number> zuk_2014(const Number& square, const Number& inverse_distance, const RadiusI& a_i,
                                        const RadiusJ& a_j) {
  const auto apart = zuk_2014_apart(inverse_distance, shared_size(a_i), shared_size(a_j));
  const auto overlapping = zuk_2014_overlapping(square, inverse_distance, a_i, a_j);
  const auto reach = a_i + a_j;
  const auto are_apart = square > reach * reach;
  return {select(are_apart, apart.isotropic, overlapping.isotropic),
          select(are_apart, apart.radial, overlapping.radial)};
}

}  // namespace talus::hydrodynamics
