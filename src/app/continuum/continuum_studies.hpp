// SPDX-License-Identifier: Apache-2.0
/// What a reference asks of runs of the continuum model.
#pragma once

#include <vector>

#include "app/comparison/studied_runs.hpp"

namespace talus::app {

/// \throws FileError
StudiedRuns study_hoppers(const std::vector<FoundEnsemble>& found);

}  // namespace talus::app
