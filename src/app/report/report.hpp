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
  std::string title;
  std::vector<ReportEntry> runs;         ///< at least one
  std::vector<std::string> comparisons;  ///< as to_json() gives them (evaluation.hpp)
  ReportLimits limits = {};
};

/// \throws FileError; InputError if a manifest's case cannot be read
void write_report(const ReportRequest& request, const std::filesystem::path& path, ReadRuns& runs);

/// The report of one run in its own folder, with what a paper prints about its case.
/// \throws FileError, InputError
void write_run_report(const std::filesystem::path& folder, ReadRuns& runs);

/// The title of its case, or the name of its folder. \throws FileError
std::string title_of_run(const std::filesystem::path& folder);

/// A run as an entry. \throws FileError if there is none
ReportEntry entry_of_run(const std::filesystem::path& folder);

/// The comparison of the runs below a folder with the papers of validation/ that they are about. Rows that a run is too
/// short for have no value and say so. \throws FileError, InputError if a reference cannot be read
std::vector<std::string> published_comparisons(const std::filesystem::path& folder, ReadRuns& runs);

}  // namespace talus::app
