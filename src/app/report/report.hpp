// SPDX-License-Identifier: Apache-2.0
/// report.html of runs, ensembles and reproductions: particles, curves, summary, validity report, comparison and case,
/// in one file that needs nothing else.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/case/opened_run.hpp"
#include "numerics/run_record.hpp"

namespace talus::app {

/// What a report carries at most of one run.
struct ReportLimits {
  std::size_t particles = 20000, frames = 100;
  std::size_t arrows = 2000;  ///< of the air, a frame
};

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
/// \param open a run that is open already, null: none
void write_report(const ReportRequest& request, const std::filesystem::path& path, OpenedRun* open = nullptr);

/// The report of one run in its own folder, with what a paper prints about its case.
/// \throws FileError, InputError
void write_run_report(OpenedRun& run);

/// The title of its case, or the name of its folder. \throws FileError
std::string title_of_run(const std::filesystem::path& folder);

/// Appends the blocks of the particles and of the air, and describes them:
///
///     {"time": [s...], "of_frames", "count", "of_particles", "levels_of_fields",
///      "position": [{"low", "high", "levels", "block"} x 3],
///      "fields": [{"name", "unit", "low", "high", "levels", "block"}...],
///      "identity": block or absent where the n-th particle is number n,
///      "air": {"count": [3], "low": [3], "spacing": [3], "velocity": [{...} x 3]} or absent}
///
/// Vectors are also given by their size, a stress by its pressure, a third of the trace; columns that never change are
/// left out, the radius apart. Particles are chosen by their numbers, evenly; frames evenly over the time, the first
/// and the last among them. Air in a box that is thin along an axis is its middle layer.
/// \param origin time from which the frames count, s \returns null where there are no snapshots
/// \throws FileError
nlohmann::ordered_json pack_run(const std::filesystem::path& folder, double origin, const ReportLimits& limits,
                                std::vector<std::string>& blocks);

/// Frames of `count`, at most `most` of them, evenly, the first and the last among them.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

/// At most about `most` rows: where there are more, of every stretch of rows the least value of each column and its
/// largest, in the order in which they came; their times are the stretch's first and middle one.
Series thinned(const Series& table, std::size_t most);

/// Mean forces on the walls over a hundredth of the time, from the impulses in a run's series: columns time,
/// force_WALL_x ..., N. No columns where there are no walls.
Series forces_on_walls(const Series& series);

/// The files of a part of a run's folder with this ending, such as "analysis" and ".csv", sorted; where the folder
/// keeps a list of what Talus wrote, of those in it. \throws FileError
std::vector<std::filesystem::path> files_of_run(const std::filesystem::path& folder, const std::string& part,
                                                const std::string& ending);

/// Appends the columns as blocks of numbers and describes them, those without a number left out:
/// {"name", "rows", "of_rows", "columns": [{"name", "unit", "block"}...]}, the time first.
/// \param origin from which the time counts, in its unit
nlohmann::ordered_json pack_table(const std::string& name, const Series& table, double origin,
                                  std::vector<std::string>& blocks);

/// The tables of a run: those in analysis/ with the time first, the forces, the series.
/// \param origin of the series' time, s \throws FileError
nlohmann::ordered_json pack_tables(const std::filesystem::path& folder, const Series& series, double origin,
                                   std::vector<std::string>& blocks);

}  // namespace talus::app
