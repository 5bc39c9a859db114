// SPDX-License-Identifier: Apache-2.0
/// The part of the stress that depends on the rate: collisions of two grains at a time.
/// Source: Yuu & Umekage 2011, Eqs 13 and 14, after Yuu et al. 1997. Range: less than 5 % of the strain-rate
/// independent stress while (D/g)^(1/2) du_i/dx_j stays below 0.2 (i != j) and 0.04 (i = j); the paper's own flow
/// reaches 0.2 and 0.05 (section 2.1).
#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "base/parameter.hpp"
#include "base/tensor.hpp"

namespace talus::granular {

enum class Collisions { printed, isotropic, none };

/// Up to which rates Eqs 13 and 14 are taken at their word.
enum class CollisionRange {
  unlimited,  ///< any rate, as printed
  printed     ///< the rate enters with at most the largest one of the paper's flow
};

/// (D/g)^(1/2) du_i/dx_j of that flow, i != j and i = j.
inline constexpr double max_shear_rate = 0.2, max_normal_rate = 0.05;

/// The table [collisions] of a case.
struct CollisionParameters {
  Collisions form = Collisions::none;
  double normal = 1.67;   ///< B1
  double shear = 0.0175;  ///< B2
  CollisionRange range = CollisionRange::unlimited;
};

/// Every key, once.
template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) requires std::same_as<std::remove_const_t<P>, CollisionParameters> {
  visit(Parameter{"collisions.form",
                  {},
                  {},
                  "stress by collisions, Eqs 13 and 14: component by component as printed, in isotropic form, or none"},
        p.form);
  auto colliding = only_if(unless("collisions.form", p.form, Collisions::none), visit);
  colliding(Parameter{"collisions.normal", dimension::none, at_least(0), "B1 of Eq. 13"}, p.normal);
  colliding(Parameter{"collisions.shear", dimension::none, at_least(0), "B2 of Eq. 14"}, p.shear);
  colliding(Parameter{"collisions.range",
                      {},
                      {},
                      "rates at which Eqs 13 and 14 hold: any, or those of the paper's flow: beyond (D/g)^(1/2) "
                      "du_i/dx_j = 0.2 (i != j) and 0.05 (i = j) the stress by collisions stays what it is there"},
            p.range);
}

/// Eqs 13 and 14, compression positive: -B (D/g)^(1/2) gamma_ij tau with gamma_ij = du_i/dx_j + du_j/dx_i for i != j.
/// deviates: gamma_ii, which is not defined in print, is du_i/dx_i. The printed components give rotated axes another
/// stress, B1 being 95 times B2; the isotropic reading does not:
///     tau_ij = -(D/g)^(1/2) tau (B1 tr(D)/3 delta_ij + 2 B2 D_dev,ij)
/// With range = printed a rate beyond the range enters as the range's end: in the component formulas each of |2 D_ij|
/// and |D_ii|; in the isotropic form its two invariants, the shear rate 2^(1/2) |D_dev| and |tr(D)|/3, which are those
/// components in simple shear and in uniform compression. The spin, which no stress may feel, never enters.
/// \param fall_time (D/g)^(1/2), s, of the grains' diameter D_p; \param mean_stress tau of Eq. 8, Pa, >= 0
/// \param velocity_gradient 1/s; \returns Pa; zero without collisions
template <class Number>
SymmetricTensor3<Number> collisional_stress(const CollisionParameters& p, double fall_time, const Number& mean_stress,
                                            const Tensor3<Number>& velocity_gradient) {
  if (p.form == Collisions::none) return {};
  const bool unlimited = p.range == CollisionRange::unlimited;
  const auto within = [&](const Number& x, double bound) {
    const double most = bound / fall_time;
    return unlimited ? x : maximum(Number(-most), minimum(x, Number(most)));
  };
  const Number scale = -fall_time * mean_stress;
  const SymmetricTensor3<Number> rate = symmetric_part(velocity_gradient);
  if (p.form == Collisions::isotropic) {
    const Number expansion = within(trace(rate), 3 * max_normal_rate);
    SymmetricTensor3<Number> sheared = deviator(rate);
    if (!unlimited) {
      const Number most = max_shear_rate / fall_time / 1.4142135623730951;  // of |D_dev| = rate/2^(1/2)
      sheared = (most / maximum(norm(sheared), most)) * sheared;
    }
    return scale * (isotropic<Number>((p.normal / 3.0) * expansion) + (2.0 * p.shear) * sheared);
  }
  const Number normal = p.normal * scale;
  const Number shear = (2.0 * p.shear) * scale;
  const auto along = [&](const Number& x) { return normal * within(x, max_normal_rate); };
  const auto across = [&](const Number& x) { return shear * within(x, 0.5 * max_shear_rate); };
  return {along(rate.xx), along(rate.yy), along(rate.zz), across(rate.xy), across(rate.yz), across(rate.zx)};
}

}  // namespace talus::granular

namespace talus {
template <>
inline constexpr auto choices<granular::Collisions> = std::to_array<std::string_view>({"printed", "isotropic", "none"});
template <>
inline constexpr auto choices<granular::CollisionRange> = std::to_array<std::string_view>({"unlimited", "printed"});
}  // namespace talus
