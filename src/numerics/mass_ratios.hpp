// SPDX-License-Identifier: Apache-2.0
/// Masses of particles over a unit, that of a particle of the spacing that the case gives.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace talus {

/// One entry per particle; none at all where every particle has the same mass: then each is 1.
struct MassRatios {
  std::span<const double> of;
  double operator[](std::size_t i) const { return of.empty() ? 1 : of[i]; }
};

/// Unequal masses are whole numbers of this part of the unit.
inline constexpr double parts_of_mass = 8;

/// The volume over that of a particle of unit mass by which a particle has a smoothing length: lighter ones about the
/// axis of a sector have that of the unit (continuum/setup/levels.hpp).
inline double size_ratio(double mass_ratio) {
  return std::max(1.0, mass_ratio);
}

}  // namespace talus
