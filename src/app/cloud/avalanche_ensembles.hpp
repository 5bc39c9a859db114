// SPDX-License-Identifier: Apache-2.0
/// Ensembles of avalanches, one a case and radius, as Niiya, Awazu & Nishimori 2020 study them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/avalanche.hpp"
#include "app/comparison/studied_runs.hpp"

namespace talus::app {

/// The runs of one case at one radius.
struct AvalancheEnsemble {
  std::string case_name;
  std::string radius;  ///< "2.5 mm"
  double contact_weight_ratio = 0;
  std::vector<std::filesystem::path> folders;  ///< in the order of the seeds
  std::vector<AvalancheRun> runs;              ///< the same order
};

/// \throws FileError
std::unique_ptr<StudiedRuns> read_avalanche_ensembles(const std::vector<FoundEnsemble>& found);

}  // namespace talus::app
