// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/studied_runs.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "analysis/row_values.hpp"
#include "app/cloud/cloud_analysis.hpp"
#include "app/cloud/cloud_case.hpp"
#include "app/continuum/continuum_analysis.hpp"
#include "app/continuum/continuum_case.hpp"
#include "io/run_folder.hpp"
#include "io/summary.hpp"

namespace talus::app {

namespace {

template <class Run>
struct Ensemble {
  std::string case_name, variant;
  std::vector<Run> runs;  ///< in the order of the seeds
};

/// \param read makes a run from its folder and its resolved case
template <class Run, class Read>
StudiedRuns studied(const std::vector<FoundEnsemble>& found, MeasuresOfModel<Run> measures, Read&& read) {
  const auto ensembles = std::make_shared<std::vector<Ensemble<Run>>>();
  for (const FoundEnsemble& e : found) {
    ensembles->push_back({e.case_name, e.variant, {}});
    for (std::size_t n = 0; n < e.folders.size(); ++n) ensembles->back().runs.push_back(read(e.folders[n], e.files[n]));
  }
  return [ensembles, measures](const ComparisonRow& row) {
    std::vector<const std::vector<Run>*> groups;
    for (const std::string& variant : row.variants) {
      const auto found = std::find_if(ensembles->begin(), ensembles->end(), [&](const Ensemble<Run>& e) {
        return e.case_name == row.case_name && e.variant == variant;
      });
      groups.push_back(found == ensembles->end() ? nullptr : &found->runs);
    }
    return RowValues<Run>(row, std::move(groups), measures).values();
  };
}

HopperRun hopper_run(const std::filesystem::path& folder, const CaseFile& file) {
  HopperRun run = read_hopper(folder, hopper_setting_of(file));
  run.wall_seconds = read_summary(RunFolder(folder).summary()).wall_seconds;
  return run;
}

AvalancheRun cloud_run(const std::filesystem::path& folder, const CaseFile& file) {
  const CloudStudy study = study_of(file);
  AvalancheRun run = read_avalanche(folder, study.frame);
  run.contact_weight_ratio = study.contact_weight_ratio;
  return run;
}

/// Nothing is random in such a run.
HopperRun only_one(std::span<const HopperRun> runs) {
  if (runs.size() != 1) throw std::invalid_argument("runs of a hopper have no mean");
  return runs.front();
}

}  // namespace

StudiedRuns read_studied_runs(const std::vector<FoundEnsemble>& found) {
  const CaseEntry* model = found.front().files.front().find("model");
  const auto* name = model ? std::get_if<std::string>(&model->value.value) : nullptr;
  if (name && *name == "continuum")
    return studied<HopperRun>(found, {hopper_measures(), hopper_pair_measures(), only_one}, hopper_run);
  return studied<AvalancheRun>(found, {avalanche_measures(), avalanche_group_measures(), mean_run}, cloud_run);
}

}  // namespace talus::app
