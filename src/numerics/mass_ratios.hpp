// SPDX-License-Identifier: Apache-2.0
/// Masses of particles over that of the finest.
#pragma once

#include <cstddef>
#include <span>

namespace talus {

/// One entry per particle; none at all where every particle has the same mass: then each is 1.
struct MassRatios {
  std::span<const double> of;
  double operator[](std::size_t i) const { return of.empty() ? 1 : of[i]; }
};

}  // namespace talus
