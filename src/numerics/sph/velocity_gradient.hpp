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
    const Number weight = -1.0 * volume * slope;
    const Number x = weight * d.x, y = weight * d.y, z = weight * d.z;
    moment.xx = multiply_add(x, d.x, moment.xx), moment.yy = multiply_add(y, d.y, moment.yy),
    moment.zz = multiply_add(z, d.z, moment.zz);
    moment.xy = multiply_add(x, d.y, moment.xy), moment.yz = multiply_add(y, d.z, moment.yz),
    moment.zx = multiply_add(z, d.x, moment.zx);
    velocity.xx = multiply_add(x, du.x, velocity.xx), velocity.xy = multiply_add(y, du.x, velocity.xy),
    velocity.xz = multiply_add(z, du.x, velocity.xz);
    velocity.yx = multiply_add(x, du.y, velocity.yx), velocity.yy = multiply_add(y, du.y, velocity.yy),
    velocity.yz = multiply_add(z, du.y, velocity.yz);
    velocity.zx = multiply_add(x, du.z, velocity.zx), velocity.zy = multiply_add(y, du.z, velocity.zy),
    velocity.zz = multiply_add(z, du.z, velocity.zz);
  }
};

/// Least determinant of the moment that is inverted. On a lattice it is 1.06 within a body, 0.38 on its surface, 0.13
/// at an edge, 0.044 at a corner; lower values occur for single particles and filaments, whose neighbours hardly span
/// the space.
inline constexpr double least_moment = 0.01;

/// L = velocity . moment^-1, L_ij = du_i/dx_j, 1/s; without the correction where the neighbours do not span the space.
inline Tensor3<> velocity_gradient(const GradientSums<>& sums) {
  const Tensor3<> moment = full(sums.moment);
  return determinant(moment) > least_moment ? sums.velocity * inverse(moment) : sums.velocity;
}

}  // namespace talus::sph
