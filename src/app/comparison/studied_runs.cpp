// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/studied_runs.hpp"

#include <algorithm>
#include <cmath>

namespace talus::app {

const std::vector<StudiedRun>* StudiedRuns::find(const ComparisonRow& row, const std::string& variant) const {
  for (const Ensemble& e : ensembles_)
    if (e.case_name == row.case_name && e.variant == variant) return &e.runs;
  return nullptr;
}

std::vector<bool> StudiedRuns::are_there(const ComparisonRow& row) const {
  const Window& window = row.window;
  const double last = window.at.value_or(std::isfinite(window.to) ? window.to : window.from);
  std::vector<bool> there;
  for (const std::string& variant : row.variants) {
    const std::vector<StudiedRun>* runs = find(row, variant);
    there.push_back(
        runs && (!std::isfinite(last) ||
                 std::all_of(runs->begin(), runs->end(), [&](const StudiedRun& run) { return run.reaches(last); })));
  }
  return there;
}

RowNumbers StudiedRuns::numbers(const ComparisonRow& row) const {
  const std::optional<MeasureText> measure = find_measure(row.quantity);
  RowNumbers numbers{.of_variants = {}, .may_be_missing = measure && measure->may_be_missing};
  const std::vector<bool> there = are_there(row);
  for (std::size_t n = 0; n < row.variants.size(); ++n) {
    numbers.of_variants.emplace_back();
    if (there[n])
      for (const StudiedRun& run : *find(row, row.variants[n]))
        numbers.of_variants.back().push_back(run.number(row.quantity, row.window));
  }
  return numbers;
}

}  // namespace talus::app
