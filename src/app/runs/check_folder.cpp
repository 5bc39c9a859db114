// SPDX-License-Identifier: Apache-2.0
#include "app/runs/run_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "io/checkpoint.hpp"
#include "io/run_json.hpp"
#include "run/snapshot_writer.hpp"

namespace talus::app {

namespace {

namespace fs = std::filesystem;

bool has_checkpoint(const fs::path& folder) {
  return std::any_of(CheckpointFiles::names.begin(), CheckpointFiles::names.end(),
                     [&](std::string_view name) { return fs::is_regular_file(folder / name); });
}

/// The folder itself, or those below it: members of an ensemble, runs of a reproduction.
std::vector<fs::path> runs_in(const fs::path& path) {
  if (has_checkpoint(path)) return {path};
  std::vector<fs::path> runs;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path))
      if (entry.is_directory() && has_checkpoint(entry.path())) runs.push_back(entry.path());
  } catch (const fs::filesystem_error& error) {
    throw FileError(path.string(), "cannot read the folder: " + error.code().message());
  }
  std::sort(runs.begin(), runs.end());
  return runs;
}

bool is_done(const RunFolder& folder) {
  try {
    return read_summary(folder.summary()).status == "done";
  } catch (const FileError&) {
    return false;
  }
}

/// What is wrong with the files of one run, a line each.
std::vector<std::string> faults_of(const RunFolder& folder, std::string& found) {
  const CheckpointFiles checkpoints(folder.path());
  std::vector<std::string> faults = checkpoints.damages();
  try {
    const std::optional<CheckpointReader> checkpoint = checkpoints.load();
    if (!checkpoint) return faults;
    const run::FilesFound files = run::compare_files(folder, *checkpoint, is_done(folder));
    faults.insert(faults.end(), files.changed.begin(), files.changed.end());
    for (const std::string& path : files.missing) faults.push_back(path + ": is missing");
    found = files.has_sums ? fmt::format("{} files compared with the checksums in {}", files.compared,
                                         checkpoint->path().filename().string())
                           : "written by a version of Talus that kept no checksums: nothing was compared";
  } catch (const FileError& error) {
    faults.emplace_back(error.what());
  }
  return faults;
}

}  // namespace

void check_resumable_files(const RunFolder& folder) {
  const std::optional<CheckpointReader> checkpoint = CheckpointFiles(folder.path()).load();
  if (!checkpoint) return;
  const run::FilesFound found = run::compare_files(folder, *checkpoint, false);
  if (!found.changed.empty())
    throw FileError(folder.path().string(),
                    fmt::format("cannot be resumed, {} of its files changed since they were written: {}; put back what "
                                "was written, or --overwrite (a snapshot may also be removed: it is left out then)",
                                found.changed.size(), fmt::join(found.changed, "; ")));
  for (const std::string& path : found.missing) print_error("talus: {} is missing and is left out\n", path);
}

void check_files_of_run(const RunFolder& folder) {
  const std::optional<CheckpointReader> checkpoint = CheckpointFiles(folder.path()).load();
  if (!checkpoint) return;
  const run::FilesFound found = run::compare_files(folder, *checkpoint, is_done(folder));
  if (!found.changed.empty())
    throw FileError(folder.path().string(), fmt::format("{} of its files changed since they were written: {}",
                                                        found.changed.size(), fmt::join(found.changed, "; ")));
}

ExitStatus check_folder(const fs::path& path) {
  const std::vector<fs::path> runs = runs_in(path);
  if (runs.empty())
    throw InputError(
        {{.where = path.string(), .what = "holds no Talus run folder with a checkpoint", .allowed = "a run's folder"}});
  std::size_t bad = 0;
  for (const fs::path& run : runs) {
    std::string found = "nothing was compared";
    const std::vector<std::string> faults = faults_of(RunFolder(run), found);
    print("{}: {}{}\n", run.string(), found, faults.empty() ? "" : ":");
    for (const std::string& fault : faults) print("  ! {}\n", fault);
    if (!faults.empty()) ++bad;
  }
  if (bad == 0) return ExitStatus::done;
  print_error("talus: {} of {} run folders {} been modified\n", bad, runs.size(), bad == 1 ? "has" : "have");
  return ExitStatus::files;
}

}  // namespace talus::app
