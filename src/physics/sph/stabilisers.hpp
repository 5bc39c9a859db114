// SPDX-License-Identifier: Apache-2.0
/// Terms of a pair that damp what the particles cannot resolve, and leave linear fields as they are: densities that
/// alternate from particle to particle, and velocities that do. Both vanish as the spacing does.
#pragma once

#include "base/simd.hpp"
#include "base/tensor.hpp"

namespace talus::sph {

/// Diffusion of the density, the term of j in d rho_i/dt:
///     2 delta h c V_j psi_ij . grad W_ij,  psi_ij = [(rho_j - rho_i) - (grad rho_i + grad rho_j) . d/2] d/r^2
/// Source: Antuono, Colagrossi, Marrone & Molteni, Comput. Phys. Commun. 181, 532 (2010), "delta-SPH", delta = 0.1,
/// with corrected gradients of the density, so that a linear field stays. Symmetric but for V_j.
/// \param strength 2 delta c, m/s; \param h mean smoothing length, m; \param volume V_j, m^3; \param slope F_ij, 1/m^5
/// \param d x_j - x_i, m; \param difference rho_j - rho_i, kg/m^3; \param gradients grad rho_i + grad rho_j, kg/m^4
/// \returns kg/(m^3 s)
template <class Number, class Vector>
TALUS_INLINE constexpr Number density_diffusion(double strength, const Number& h, const Number& volume,
                                                const Number& slope, const Vector& d, const Number& difference,
                                                const Vector& gradients) {
  const Number linear = 0.5 * (gradients.x * d.x + gradients.y * d.y + gradients.z * d.z);
  return (-strength) * h * volume * slope * (difference - linear);
}

/// The part of a pair's approach that the gradients of the velocity do not explain, (du - (L_i + L_j) d/2) . d =
/// du . d - d . (D_i + D_j) d/2, m^2/s: zero in any linear field. Its damping is the viscous counterpart of the penalty
/// on non-affine displacements of Ganzenmueller, Comput. Methods Appl. Mech. Eng. 286, 87 (2015); nothing is remembered
/// of a pair.
/// \param approach du . d; \param d x_j - x_i, m; \param rates D_i + D_j, D the symmetric part of L_ij = du_i/dx_j, 1/s
template <class Number, class Vector>
TALUS_INLINE constexpr Number unexplained_approach(const Number& approach, const Vector& d,
                                                   const SymmetricTensor3<Number>& rates) {
  const Number x = rates.xx * d.x + rates.xy * d.y + rates.zx * d.z;
  const Number y = rates.xy * d.x + rates.yy * d.y + rates.yz * d.z;
  const Number z = rates.zx * d.x + rates.yz * d.y + rates.zz * d.z;
  return approach - 0.5 * (x * d.x + y * d.y + z * d.z);
}

/// Pi_ij of that damping, -zeta c h w/((r^2 + 0.01 h^2) rho) for an unexplained approach w: as the linear part of
/// Monaghan's viscosity (artificial_viscosity.hpp), but for w of either sign. \returns m^5/(kg s^2)
template <class Number>
TALUS_INLINE constexpr Number hourglass_damping(double strength, const Number& unexplained,
                                                const Number& distance_squared, const Number& h,
                                                const Number& density) {
  return (-strength) * h * unexplained / ((distance_squared + 0.01 * h * h) * density);
}

}  // namespace talus::sph
