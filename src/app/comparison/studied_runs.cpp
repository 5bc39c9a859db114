// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/studied_runs.hpp"

#include "app/cloud/avalanche_ensembles.hpp"
#include "app/continuum/hopper_ensembles.hpp"

namespace talus::app {

std::unique_ptr<StudiedRuns> read_studied_runs(const std::vector<FoundEnsemble>& found) {
  const CaseEntry* model = found.front().files.front().find("model");
  const auto* name = model ? std::get_if<std::string>(&model->value.value) : nullptr;
  if (name && *name == "continuum") return read_hopper_ensembles(found);
  return read_avalanche_ensembles(found);
}

}  // namespace talus::app
