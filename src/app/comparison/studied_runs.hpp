// SPDX-License-Identifier: Apache-2.0
/// The runs of a reference, read, and the numbers of its rows.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "app/comparison/found_runs.hpp"
#include "app/comparison/reference.hpp"

namespace talus::app {

/// A row's numbers: one a variant of the row, or one alone if it is made from several; nothing where the runs that it
/// needs are not there. \throws std::logic_error if the row asks for what no such runs have
using StudiedRuns = std::function<std::vector<std::optional<double>>(const ComparisonRow& row)>;

/// Reads runs, all of one model, at least one ensemble. \throws FileError
StudiedRuns read_studied_runs(const std::vector<FoundEnsemble>& found);

}  // namespace talus::app
