// SPDX-License-Identifier: Apache-2.0
/// report.html of runs, ensembles and reproductions: particles, curves, summary, regime card, comparison and case, in
/// one file that needs nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/case/read_runs.hpp"
#include "app/report/frames.hpp"
#include "numerics/series.hpp"

namespace talus::app {

/// A run, or the members of an ensemble together.
struct ReportEntry {
  std::filesystem::path folder;  ///< of the run, or of the member that is shown
  std::string name;
  std::size_t members = 1;
  /// Of an ensemble: its tables, columns time, NAME_mean and NAME_deviation.
  std::vector<std::pair<std::string, Series>> bands = {};
  /// Of an ensemble: the values of its members.
  struct Quantity {
    std::string name, unit;
    std::vector<double> values;
  };
  std::vector<Quantity> quantities = {};
};

struct ReportRequest {
  std::string title = {};
  std::vector<ReportEntry> runs = {};         ///< at least one
  std::vector<std::string> comparisons = {};  ///< JSON, as talus.evaluation gives them
  ReportLimits limits = {};
};

/// What a page shows, from JSON as talus.lab.gathered gives it.
ReportRequest request_of(const std::string& json);

/// The runs at or below a folder, those of an ensemble together, and their comparison with the papers of validation/
/// that they are about: what talus.lab.gathered says; of a run without such a Python the run alone.
/// \throws FileError; InputError if there is no run that is done
ReportRequest gathered(const std::filesystem::path& folder);

/// \throws FileError; InputError if a manifest's case cannot be read
void write_report(const ReportRequest& request, const std::filesystem::path& path, ReadRuns& runs);

/// The report of one run in its own folder, with what a paper prints about its case.
/// \throws FileError, InputError
void write_run_report(const std::filesystem::path& folder, ReadRuns& runs);

/// The title of its case, or the name of its folder. \throws FileError
std::string title_of_run(const std::filesystem::path& folder);

}  // namespace talus::app
