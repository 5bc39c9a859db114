// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_studies.hpp"

#include <stdexcept>

#include "app/continuum/continuum_case.hpp"

namespace talus::app {

namespace {

/// Nothing is random in such a run.
HopperRun only_one(std::span<const HopperRun> runs) {
  if (runs.size() != 1) throw std::invalid_argument("runs of a hopper have no mean");
  return runs.front();
}

}  // namespace

StudiedRuns study_hoppers(const std::vector<FoundEnsemble>& found, ReadRuns& runs) {
  const auto read = [&](const std::filesystem::path& folder, const CaseFile& file) {
    return hopper_run_of(file, folder, runs);
  };
  return studied<HopperRun>(found, {hopper_measures(), {}, only_one}, read);
}

}  // namespace talus::app
