// SPDX-License-Identifier: Apache-2.0
/// How far a material point turns within a time step.
/// Source: Hughes & Winget, Int. J. Numer. Methods Eng. 15, 1862-1867 (1980).
#pragma once

#include "base/tensor.hpp"

namespace talus::granular {

/// (I - W dt/2)^-1 (I + W dt/2) with the spin W: a rotation to round-off, by 2 atan(t/2) for the angle t. In closed
/// form, W being antisymmetric: I + 2 (A + A^2)/(1 + |A|^2/2) with A = W dt/2.
/// \param velocity_gradient 1/s, of which the spin is the antisymmetric part
template <class Number>
Tensor3<Number> rotation_of_step(const Tensor3<Number>& velocity_gradient, double time_step) {
  const Tensor3<Number> half = (0.5 * time_step) * antisymmetric_part(velocity_gradient);
  const Number square = half.xy * half.xy + half.yz * half.yz + half.zx * half.zx;
  return full(isotropic<Number>(1.0)) + (2.0 / (1.0 + square)) * (half + half * half);
}

}  // namespace talus::granular
