// SPDX-License-Identifier: Apache-2.0
/// Kinematics of a material point: its rotation within a time step, and the Almansi strain, positive in compression: e
/// = -Ea = (B^-1 - I)/2, from displacements or by its rate. Source: Yuu & Umekage 2011, Eqs 9-12 and Appendix A.
/// deviates: the paper prints Ea = (I - B^-1)/2, negative in compression, where Eq. 17 needs the opposite sign of
/// stress; the sign is turned here, for all components.
#pragma once

#include "base/tensor.hpp"

namespace talus::granular {

/// e of f^-1 = I + g: (f^-T f^-1 - I)/2, without the loss of digits of that difference.
template <class Number>
SymmetricTensor3<Number> strain_of_inverse(const Tensor3<Number>& g) {
  return symmetric_part(g + 0.5 * (transpose(g) * g));
}

/// e from displacements d = x - X. With F = I + dd/dX, F^-1 = I - dd/dX F^-1.
/// \param displacement_gradient dd_i/dX_j, number; not finite where F has no inverse
template <class Number>
SymmetricTensor3<Number> almansi_strain(const Tensor3<Number>& displacement_gradient) {
  const Tensor3<Number> unit{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  return strain_of_inverse(-1.0 * (displacement_gradient * inverse(unit + displacement_gradient)));
}

/// de/dt = -D - e L - L^T e, which follows from d(B^-1)/dt = -B^-1 L - L^T B^-1 exactly.
template <class Number>
SymmetricTensor3<Number> strain_rate(const SymmetricTensor3<Number>& strain, const Tensor3<Number>& velocity_gradient) {
  return -1.0 * symmetric_part(velocity_gradient + 2.0 * (full(strain) * velocity_gradient));
}

/// e a time step later, by the midpoint rule: second order, and a body that turns without strain stays without. A rigid
/// rotation by the angle t a step keeps |e| to the factor 1 + 2 t^4.
/// \param velocity_gradient 1/s; \param time_step s
template <class Number>
SymmetricTensor3<Number> transported_strain(const SymmetricTensor3<Number>& strain,
                                            const Tensor3<Number>& velocity_gradient, double time_step) {
  const SymmetricTensor3<Number> middle = strain + (0.5 * time_step) * strain_rate(strain, velocity_gradient);
  return strain + time_step * strain_rate(middle, velocity_gradient);
}

/// (I - W dt/2)^-1 (I + W dt/2) with the spin W: a rotation to round-off, by 2 atan(t/2) for the angle t. In closed
/// form, W being antisymmetric: I + 2 (A + A^2)/(1 + |A|^2/2) with A = W dt/2.
/// Source: Hughes & Winget, Int. J. Numer. Methods Eng. 15, 1862-1867 (1980).
/// \param velocity_gradient 1/s, of which the spin is the antisymmetric part
template <class Number>
Tensor3<Number> rotation_of_step(const Tensor3<Number>& velocity_gradient, double time_step) {
  const Tensor3<Number> half = (0.5 * time_step) * antisymmetric_part(velocity_gradient);
  const Number square = half.xy * half.xy + half.yz * half.yz + half.zx * half.zx;
  return full(isotropic<Number>(1.0)) + (2.0 / (1.0 + square)) * (half + half * half);
}

}  // namespace talus::granular
