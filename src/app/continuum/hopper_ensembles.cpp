// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/hopper_ensembles.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/hopper_quantities.hpp"
#include "app/continuum/continuum_analysis.hpp"
#include "app/continuum/continuum_case.hpp"
#include "io/run_folder.hpp"
#include "io/summary.hpp"

namespace talus::app {

namespace {

constexpr double tolerance_of_end = 1e-3;  // s; a run ends with the step that reaches its end, or just before

class HopperEnsembles : public StudiedRuns {
 public:
  explicit HopperEnsembles(std::vector<HopperEnsemble> ensembles) : ensembles_(std::move(ensembles)) {}

  std::vector<std::optional<double>> values(const ComparisonRow& row) const override {
    std::vector<const HopperEnsemble*> of_variants;
    for (const std::string& variant : row.variants) {
      const auto found = std::find_if(ensembles_.begin(), ensembles_.end(), [&](const HopperEnsemble& e) {
        return e.case_name == row.case_name && e.variant == variant;
      });
      of_variants.push_back(found == ensembles_.end() ? nullptr : &*found);
    }
    if (row.from == From::variants) return {of_pair(row, of_variants)};
    std::vector<std::optional<double>> values;
    for (const HopperEnsemble* ensemble : of_variants)
      values.push_back(ensemble ? of_members(row, *ensemble) : std::nullopt);
    return values;
  }

 private:
  /// Nothing if a run ends before the row's window does.
  static std::optional<double> of_members(const ComparisonRow& row, const HopperEnsemble& ensemble) {
    std::vector<double> numbers;
    for (const HopperRun& run : ensemble.runs) {
      if (!reaches(run, row.window)) return std::nullopt;
      numbers.push_back(hopper_quantity(row.quantity, run, row.window));
    }
    return evaluate(row.statistic, numbers);
  }

  static bool reaches(const HopperRun& run, const Window& window) {
    const double last = window.at.value_or(window.to);
    return !std::isfinite(last) || run.end() >= last - tolerance_of_end;
  }

  static std::optional<double> of_pair(const ComparisonRow& row, const std::vector<const HopperEnsemble*>& pair) {
    if (pair.size() != 2 || !pair[0] || !pair[1]) return std::nullopt;
    if (!reaches(pair[0]->runs.front(), row.window) || !reaches(pair[1]->runs.front(), row.window)) return std::nullopt;
    return hopper_pair_quantity(row.quantity, pair[0]->runs.front(), pair[1]->runs.front(), row.window);
  }

  std::vector<HopperEnsemble> ensembles_;
};

}  // namespace

std::unique_ptr<StudiedRuns> read_hopper_ensembles(const std::vector<FoundEnsemble>& found) {
  std::vector<HopperEnsemble> ensembles;
  for (const FoundEnsemble& e : found) {
    HopperEnsemble& ensemble = ensembles.emplace_back(HopperEnsemble{e.case_name, e.variant, e.folders, {}});
    for (std::size_t n = 0; n < e.folders.size(); ++n) {
      ensemble.runs.push_back(read_hopper(e.folders[n], hopper_setting_of(e.files[n])));
      ensemble.runs.back().wall_seconds = read_summary(RunFolder(e.folders[n]).summary()).wall_seconds;
    }
  }
  return std::make_unique<HopperEnsembles>(std::move(ensembles));
}

}  // namespace talus::app
