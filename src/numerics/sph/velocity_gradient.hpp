// SPDX-License-Identifier: Apache-2.0
/// The velocity gradient of a lump from its neighbours, corrected so that it is exact for every linear velocity field,
/// at free surfaces too.
/// Source: Randles & Libersky, Comput. Methods Appl. Mech. Eng. 139, 375-408 (1996), Eq. 58; Bonet & Lok 1999.
#pragma once

#include "base/tensor.hpp"
#include "base/vector.hpp"

namespace talus::sph {

/// Sums over the neighbours j of i, with d = x_j - x_i and w = -V_j F_ij >= 0:
/// moment = sum w d d (about the unit tensor within a body), velocity = sum w (u_j - u_i) d.
struct GradientSums {
  SymmetricTensor3<> moment;
  Tensor3<> velocity;

  /// \param volume V_j, m^3; \param slope F_ij, 1/m^5; \param d x_j - x_i, m; \param du u_j - u_i, m/s
  constexpr void add(double volume, double slope, const Vector3& d, const Vector3& du) {
    const double weight = -volume * slope;
    const double x = weight * d.x, y = weight * d.y, z = weight * d.z;
    moment.xx += x * d.x, moment.yy += y * d.y, moment.zz += z * d.z;
    moment.xy += x * d.y, moment.yz += y * d.z, moment.zx += z * d.x;
    velocity.xx += x * du.x, velocity.xy += y * du.x, velocity.xz += z * du.x;
    velocity.yx += x * du.y, velocity.yy += y * du.y, velocity.yz += z * du.y;
    velocity.zx += x * du.z, velocity.zy += y * du.z, velocity.zz += z * du.z;
  }
};

/// Least determinant of the moment that is inverted. On a lattice it is 1.06 within a body, 0.38 on its surface, 0.13 at
/// an edge, 0.044 at a corner; below stand single lumps and threads of them, whose neighbours hardly span the space.
inline constexpr double least_moment = 0.01;

/// L = velocity . moment^-1, L_ij = du_i/dx_j, 1/s; without the correction where the neighbours do not span the space.
inline Tensor3<> velocity_gradient(const GradientSums& sums) {
  const Tensor3<> moment = full(sums.moment);
  return determinant(moment) > least_moment ? sums.velocity * inverse(moment) : sums.velocity;
}

}  // namespace talus::sph
