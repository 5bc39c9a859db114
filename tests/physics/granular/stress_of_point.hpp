// SPDX-License-Identifier: Apache-2.0
/// A point of the law critical-state and the invariants of its stress, for the tests of the law.
#pragma once

#include <cmath>

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

}  // namespace talus::granular
