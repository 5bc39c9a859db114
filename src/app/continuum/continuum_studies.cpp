// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_studies.hpp"

#include "app/continuum/continuum_case.hpp"
#include "io/run_folder.hpp"
#include "io/summary.hpp"

namespace talus::app {

namespace {

HopperRun hopper_run(const std::filesystem::path& folder, const CaseFile& file, ReadRuns& runs) {
  HopperRun run = hopper_run_of(file, folder, runs);
  run.wall_seconds = read_summary(RunFolder(folder).summary()).wall_seconds;
  return run;
}

}  // namespace

StudiedRuns study_hoppers(const std::vector<FoundEnsemble>& found, ReadRuns& runs) {
  const auto read = [&](const std::filesystem::path& folder, const CaseFile& file) {
    return hopper_run(folder, file, runs);
  };
  return studied<HopperRun>(found, {hopper_measures(), hopper_pair_measures()}, read);
}

}  // namespace talus::app
