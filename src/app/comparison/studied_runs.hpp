// SPDX-License-Identifier: Apache-2.0
/// The runs of a reference, read, and the numbers of its rows.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/row_values.hpp"
#include "app/comparison/found_runs.hpp"
#include "app/comparison/reference.hpp"

namespace talus::app {

struct StudiedRuns {
  /// A row's numbers: one per variant of the row, or one alone if it is made from several; nothing where the runs that
  /// it needs are not there. \throws std::logic_error if the row asks for what no such runs have
  std::function<std::vector<std::optional<double>>(const ComparisonRow& row)> values;
  /// Whether the runs of each of the row's variants are there and go on to the end of its window.
  std::function<std::vector<bool>(const ComparisonRow& row)> are_there;
};

template <class Run>
struct StudiedEnsemble {
  std::string case_name, variant;
  std::vector<Run> runs;  ///< in the order of the seeds
};

/// The runs of one model with its measures. \param read makes a run from its folder and its resolved case
template <class Run, class Read>
StudiedRuns studied(const std::vector<FoundEnsemble>& found, std::span<const Measure<Run>> measures, Read&& read) {
  const auto ensembles = std::make_shared<std::vector<StudiedEnsemble<Run>>>();
  for (const FoundEnsemble& e : found) {
    ensembles->push_back({e.case_name, e.variant, {}});
    for (std::size_t n = 0; n < e.folders.size(); ++n) ensembles->back().runs.push_back(read(e.folders[n], e.files[n]));
  }
  const auto row_values = [ensembles, measures](const ComparisonRow& row) {
    std::vector<const std::vector<Run>*> groups;
    for (const std::string& variant : row.variants) {
      const auto ensemble = std::find_if(ensembles->begin(), ensembles->end(), [&](const StudiedEnsemble<Run>& e) {
        return e.case_name == row.case_name && e.variant == variant;
      });
      groups.push_back(ensemble == ensembles->end() ? nullptr : &ensemble->runs);
    }
    return RowValues<Run>(row, std::move(groups), measures);
  };
  return {[row_values](const ComparisonRow& row) { return row_values(row).values(); },
          [row_values](const ComparisonRow& row) { return row_values(row).are_there(); }};
}

}  // namespace talus::app
