// SPDX-License-Identifier: Apache-2.0
/// The part of the stress that depends on the rate: collisions of two grains at a time.
/// Source: Yuu & Umekage 2011, Eqs 13 and 14, after Yuu et al. 1997. Range: less than 5 % of the strain-rate
/// independent stress while (D/g)^(1/2) du_i/dx_j stays below 0.2 (i != j) and 0.04 (i = j).
#pragma once

#include "base/tensor.hpp"

namespace talus::granular {

struct CollisionOptions {
  double diameter = 2e-4;  ///< D_p, m
  double gravity = 9.8;    ///< g, m/s^2
  double normal = 1.67;    ///< B1
  double shear = 0.0175;   ///< B2
  /// gamma_ii over du_i/dx_i: 2 if gamma_ij = du_i/dx_j + du_j/dx_i is meant for i = j too.
  double diagonal_factor = 1;
  bool isotropic = false;  ///< B1 on the volumetric, B2 on the deviatoric rate, in place of the printed components
};

/// Eqs 13 and 14, compression positive: -B (D/g)^(1/2) gamma_ij tau with gamma_ij = du_i/dx_j + du_j/dx_i for i != j.
/// deviates: gamma_ii, which is not defined in print, is du_i/dx_i. The printed components give rotated axes another
/// stress, B1 being 95 times B2; the isotropic reading does not:
///     tau_ij = -(D/g)^(1/2) tau (B1 tr(D)/3 delta_ij + 2 B2 D_dev,ij)
/// \param mean_stress tau of Eq. 8, Pa, >= 0; \param velocity_gradient 1/s; \returns Pa
template <class Number>
SymmetricTensor3<Number> collisional_stress(const CollisionOptions& o, const Number& mean_stress,
                                            const Tensor3<Number>& velocity_gradient) {
  const Number scale = -std::sqrt(o.diameter / o.gravity) * mean_stress;
  const SymmetricTensor3<Number> rate = symmetric_part(velocity_gradient);
  if (o.isotropic)
    return scale * (isotropic<Number>((o.normal / 3.0) * trace(rate)) + (2.0 * o.shear) * deviator(rate));
  const Number normal = (o.normal * o.diagonal_factor) * scale;
  const Number shear = (2.0 * o.shear) * scale;
  return {normal * rate.xx, normal * rate.yy, normal * rate.zz, shear * rate.xy, shear * rate.yz, shear * rate.zx};
}

}  // namespace talus::granular
