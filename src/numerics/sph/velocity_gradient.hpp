// SPDX-License-Identifier: Apache-2.0
/// The velocity gradient of a particle from its neighbours, corrected so that it is exact for every linear velocity
/// field, at free surfaces too. Source: Randles & Libersky, Comput. Methods Appl. Mech. Eng. 139, 375-408 (1996), Eq.
/// 58; Bonet & Lok 1999.
#pragma once

#include "base/simd.hpp"
#include "base/tensor.hpp"
#include "base/vector.hpp"

namespace talus::sph {

/// Sums over the neighbours j of i, with d = x_j - x_i and w = -V_j F_ij >= 0:
/// moment = sum w d d (about the unit tensor within a body), velocity = sum w (u_j - u_i) d.
template <class Number = double>
struct GradientSums {
  SymmetricTensor3<Number> moment;
  Tensor3<Number> velocity;

  /// \param volume V_j, m^3; \param slope F_ij, 1/m^5; \param d x_j - x_i, m; \param du u_j - u_i, m/s
  template <class Vector = Vector3>
  constexpr void add(const Number& volume, const Number& slope, const Vector& d, const Vector& du) {
    const Number weight = volume * slope;  // -w
    const Number x = weight * d.x, y = weight * d.y, z = weight * d.z;
    const auto subtract = [](Number& sum, const Number& a, const Number& b) { sum = negative_multiply_add(a, b, sum); };
    subtract(moment.xx, x, d.x), subtract(moment.yy, y, d.y), subtract(moment.zz, z, d.z);
    subtract(moment.xy, x, d.y), subtract(moment.yz, y, d.z), subtract(moment.zx, z, d.x);
    subtract(velocity.xx, x, du.x), subtract(velocity.xy, y, du.x), subtract(velocity.xz, z, du.x);
    subtract(velocity.yx, x, du.y), subtract(velocity.yy, y, du.y), subtract(velocity.yz, z, du.y);
    subtract(velocity.zx, x, du.z), subtract(velocity.zy, y, du.z), subtract(velocity.zz, z, du.z);
  }
};

/// Least determinant of the moment that is inverted. On a lattice it is 1.06 within a body, 0.38 on its surface, 0.13
/// at an edge, 0.044 at a corner; lower values occur for single particles and filaments, whose neighbours hardly span
/// the space.
inline constexpr double min_moment = 0.01;

/// L = velocity . moment^-1, L_ij = du_i/dx_j, 1/s; without the correction where the neighbours do not span the space.
template <class Number>
Tensor3<Number> velocity_gradient(const GradientSums<Number>& sums) {
  const Tensor3<Number> moment = full(sums.moment), raw = sums.velocity, l = raw * inverse(moment);
  const auto spanned = determinant(moment) > Number(min_moment);
  return {select(spanned, l.xx, raw.xx), select(spanned, l.xy, raw.xy), select(spanned, l.xz, raw.xz),
          select(spanned, l.yx, raw.yx), select(spanned, l.yy, raw.yy), select(spanned, l.yz, raw.yz),
          select(spanned, l.zx, raw.zx), select(spanned, l.zy, raw.zy), select(spanned, l.zz, raw.zz)};
}

inline Tensor3<> velocity_gradient(const GradientSums<>& sums) {
  return velocity_gradient<double>(sums);
}

}  // namespace talus::sph
