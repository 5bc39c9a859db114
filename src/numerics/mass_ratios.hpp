// SPDX-License-Identifier: Apache-2.0
/// Masses of particles over that of the finest.
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

/// Of which masses with levels are whole numbers, in that of the finest.
inline constexpr double parts_of_mass = 8;

/// The size of a particle goes with its mass, but never below that of the finest: lighter ones share its place
/// (Levels::wanted). \returns the volume over that of the finest by which it has a smoothing length
inline double size_ratio(double mass_ratio) { return std::max(1.0, mass_ratio); }

}  // namespace talus
