// SPDX-License-Identifier: Apache-2.0
/// The runs of a reference, read, and what a study asks of them: the numbers of its rows.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/comparison/found_runs.hpp"
#include "app/comparison/reference.hpp"

namespace talus::app {

class StudiedRuns {
 public:
  virtual ~StudiedRuns() = default;

  /// A row's numbers: one a variant of the row, or one alone if it is made from several; nothing where the runs that it
  /// needs are not there.
  /// \throws std::logic_error if the row asks for what no such runs have
  virtual std::vector<std::optional<double>> values(const ComparisonRow& row) const = 0;
};

/// Reads runs that were found. \param found at least one \throws FileError
std::unique_ptr<StudiedRuns> read_studied_runs(const std::vector<FoundEnsemble>& found);

}  // namespace talus::app
