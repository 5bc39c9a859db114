// SPDX-License-Identifier: Apache-2.0
/// How far particles have moved between two times, so that sound is not taken for flow.
#pragma once

#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// Size of each particle's displacement since an earlier snapshot over the time between, m/s, in the order of `now`.
/// Particles are known by the column "identity"; nan for one that was not there.
/// \throws std::invalid_argument if `before` is not earlier
std::vector<double> mean_speeds(const Snapshot& before, const Snapshot& now);

}  // namespace talus
