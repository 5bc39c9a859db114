// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/avalanche_ensembles.hpp"

#include <algorithm>

#include "analysis/avalanche_quantities.hpp"
#include "app/cloud/cloud_analysis.hpp"
#include "app/cloud/cloud_case.hpp"

namespace talus::app {

namespace {

class AvalancheEnsembles : public StudiedRuns {
 public:
  explicit AvalancheEnsembles(std::vector<AvalancheEnsemble> ensembles) : ensembles_(std::move(ensembles)) {}

  std::vector<std::optional<double>> values(const ComparisonRow& row) const override {
    std::vector<std::optional<double>> values;
    std::vector<std::vector<AvalancheRun>> of_radii;
    for (const std::string& radius : row.variants) {
      const auto found = std::find_if(ensembles_.begin(), ensembles_.end(), [&](const AvalancheEnsemble& e) {
        return e.case_name == row.case_name && e.radius == radius;
      });
      if (found == ensembles_.end()) {
        values.push_back(std::nullopt);
      } else if (row.from == From::variants) {
        of_radii.push_back(found->runs);
      } else if (row.from == From::parameters) {
        values.push_back(found->contact_weight_ratio);
      } else {
        values.push_back(ensemble_quantity(row, found->runs));
      }
    }
    if (row.from == From::variants) return {radii_quantity(row, of_radii)};
    return values;
  }

 private:
  std::vector<AvalancheEnsemble> ensembles_;
};

}  // namespace

std::unique_ptr<StudiedRuns> read_avalanche_ensembles(const std::vector<FoundEnsemble>& found) {
  std::vector<AvalancheEnsemble> ensembles;
  for (const FoundEnsemble& e : found) {
    AvalancheEnsemble& ensemble = ensembles.emplace_back(AvalancheEnsemble{e.case_name, e.variant, 0, e.folders, {}});
    for (std::size_t n = 0; n < e.folders.size(); ++n) {
      const CloudStudy study = study_of(e.files[n]);
      ensemble.contact_weight_ratio = study.contact_weight_ratio;
      ensemble.runs.push_back(read_avalanche(e.folders[n], study.frame));
    }
  }
  return std::make_unique<AvalancheEnsembles>(std::move(ensembles));
}

}  // namespace talus::app
