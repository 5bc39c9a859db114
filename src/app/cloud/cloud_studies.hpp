// SPDX-License-Identifier: Apache-2.0
/// What a reference asks of runs of the cloud model.
#pragma once

#include <vector>

#include "app/case/read_runs.hpp"
#include "app/comparison/studied_runs.hpp"

namespace talus::app {

/// \throws FileError
StudiedRuns study_avalanches(const std::vector<FoundEnsemble>& found, ReadRuns& runs);

}  // namespace talus::app
