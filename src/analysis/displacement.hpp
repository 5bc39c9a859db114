// SPDX-License-Identifier: Apache-2.0
/// How far grains have moved apart: whether a pattern is kept while it slides down (Niiya, Awazu & Nishimori 2020,
/// section 3.1, without the drag between grains).
#pragma once

#include <span>

#include "base/vector.hpp"

namespace talus {

struct DisplacementSpread {
  double mean = 0;     ///< displacement along x, m
  double along = 0;    ///< largest difference from the mean, along x, m
  double lateral = 0;  ///< the same across, along y, m
};

/// \param before, after positions of the same grains in the same order, at least one
/// \throws std::invalid_argument if they differ in length or are empty
DisplacementSpread displacement_spread(std::span<const Vector3> before, std::span<const Vector3> after);

}  // namespace talus
