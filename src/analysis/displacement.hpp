// SPDX-License-Identifier: Apache-2.0
/// How far grains have moved between two times: apart, so that a pattern is kept or not while it slides down (Niiya,
/// Awazu & Nishimori 2020, section 3.1, without the drag between grains); and each by itself, so that sound is not
/// taken for flow.
#pragma once

#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

struct DisplacementSpread {
  double mean = 0;     ///< displacement along x, m
  double along = 0;    ///< largest difference from the mean, along x, m
  double lateral = 0;  ///< the same across, along y, m
};

/// \param before, after positions of the same grains in the same order, at least one
/// \throws std::invalid_argument if they differ in length or are empty
DisplacementSpread displacement_spread(std::span<const Vector3> before, std::span<const Vector3> after);

/// Size of each particle's displacement since an earlier snapshot over the time between, m/s, in the order of `now`.
/// Particles are known by the column "identity"; nan for one that was not there.
/// \throws std::invalid_argument if `before` is not earlier
std::vector<double> mean_speeds(const Snapshot& before, const Snapshot& now);

}  // namespace talus
