// SPDX-License-Identifier: Apache-2.0
/// A point of the law critical-state, invariants and energy of its stress, and random deformations, for tests of the
/// law.
#pragma once

#include <cmath>

#include "base/random.hpp"
#include "physics/granular/critical_state.hpp"

namespace talus::granular {

using Point = MaterialPoint<CriticalState>;

inline constexpr double grain_density = 2500, diameter = 1e-3;  // kg/m^3, m

inline double mean(const SymmetricTensor3<>& stress) {
  return trace(stress) / 3;
}
/// (J_2)^(1/2), Pa.
inline double shear_of(const SymmetricTensor3<>& stress) {
  return norm(deviator(stress)) / std::sqrt(2.0);
}

/// Elastic energy over volume, J/m^3.
inline double stored_in(const SymmetricTensor3<>& stress, const CriticalState::Parameters& p) {
  const double pressure = mean(stress), size = norm(deviator(stress));
  return pressure * pressure / (2 * p.bulk_modulus) + size * size / (4 * p.shear_modulus);
}

/// Components spread evenly up to half the amplitude to either side, 1/s.
inline Tensor3<> random_gradient(Random& random, double amplitude) {
  Tensor3<> gradient;
  for (double* component : {&gradient.xx, &gradient.xy, &gradient.xz, &gradient.yx, &gradient.yy, &gradient.yz,
                            &gradient.zx, &gradient.zy, &gradient.zz})
    *component = amplitude * (random.uniform() - 0.5);
  return gradient;
}

}  // namespace talus::granular
