// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_studies.hpp"

#include "app/continuum/continuum_case.hpp"

namespace talus::app {

StudiedRuns study_hoppers(const std::vector<FoundEnsemble>& found, ReadRuns& runs) {
  const auto read = [&](const std::filesystem::path& folder, const CaseFile& file) {
    return hopper_run_of(file, folder, runs);
  };
  return studied<HopperRun>(found, hopper_measures(), read);
}

}  // namespace talus::app
