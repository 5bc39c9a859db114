// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_studies.hpp"

#include "app/cloud/cloud_analysis.hpp"
#include "app/cloud/cloud_case.hpp"

namespace talus::app {

namespace {

AvalancheRun cloud_run(const std::filesystem::path& folder, const CaseFile& file, ReadRuns& runs) {
  const CloudStudy study = study_of(file);
  AvalancheRun run =
      runs.of<AvalancheRun>(folder, [&] { return read_avalanche(folder, study.frame, runs.snapshot_memory()); });
  return run;
}

}  // namespace

StudiedRuns study_avalanches(const std::vector<FoundEnsemble>& found, ReadRuns& runs) {
  const auto read = [&](const std::filesystem::path& folder, const CaseFile& file) {
    return cloud_run(folder, file, runs);
  };
  return studied<AvalancheRun>(found, avalanche_measures(), read);
}

}  // namespace talus::app
