// SPDX-License-Identifier: Apache-2.0
/// The runs of a reference, read, and the numbers of its rows.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analysis/measure.hpp"
#include "app/comparison/found_runs.hpp"
#include "app/comparison/reference.hpp"

namespace talus::app {

/// One run, whatever its model.
struct StudiedRun {
  /// \throws std::logic_error if there is no such quantity of such a run, or it has no data for it
  std::function<double(const std::string& quantity, const Window& window)> number;
  std::function<bool(double time)> reaches;  ///< whether it went on to that time
};

/// \param run lives as long as what is returned
template <class Run>
StudiedRun studied(std::shared_ptr<const Run> run, std::span<const Measure<Run>> measures) {
  return {[run, measures](const std::string& quantity, const Window& window) {
            const Measure<Run>* measure = find_row(measures, quantity);
            if (!measure) throw std::out_of_range("'" + quantity + "' is no measure of such a run");
            return measure->estimator.of(*run, window);
          },
          [run](double time) { return run->reaches(time); }};
}

/// All runs, in the order of the ensembles that were found.
class StudiedRuns {
 public:
  struct Ensemble {
    std::string case_name, variant;
    std::vector<StudiedRun> runs;  ///< in the order of the seeds
  };
  explicit StudiedRuns(std::vector<Ensemble> ensembles) : ensembles_(std::move(ensembles)) {}

  /// Whether the runs of each of the row's variants are there and go on to the end of its window.
  std::vector<bool> are_there(const ComparisonRow& row) const;

  /// One a member, of the program's own quantities. \throws std::logic_error as a run's
  RowNumbers numbers(const ComparisonRow& row) const;

 private:
  const std::vector<StudiedRun>* find(const ComparisonRow& row, const std::string& variant) const;

  std::vector<Ensemble> ensembles_;
};

}  // namespace talus::app
