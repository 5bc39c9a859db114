// SPDX-License-Identifier: Apache-2.0
/// Ensembles as entries of a report.
#pragma once

#include <filesystem>
#include <vector>

#include "app/ensemble/plan.hpp"
#include "app/report/report.hpp"

namespace talus::app {

/// Groups that have a member that is done: bands of its tables, values of all members, the first one to be looked at.
std::vector<ReportEntry> entries_of(const std::vector<EnsembleGroup>& groups);

/// A folder as entries: of a run, or of the ensembles below it, one for each folder that holds members.
/// \throws FileError; InputError if there is no run that is done
std::vector<ReportEntry> entries_of_folder(const std::filesystem::path& folder);

}  // namespace talus::app
