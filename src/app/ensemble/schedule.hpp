// SPDX-License-Identifier: Apache-2.0
/// Runs the members of ensembles over the cores. The results are in the folders of the members, so a scheduler that was
/// killed continues where it was.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/ensemble/plan.hpp"

namespace talus::app {

/// A run that a scheduler is to see done.
struct ScheduledRun {
  std::string case_path;
  EnsembleMember member;
};

/// A member that did not end well.
struct FailedRun {
  std::filesystem::path folder;
  std::optional<int> status = {};  ///< exit status, where this process has seen it
  std::string reason;              ///< the last line of its errors, or of what it wrote
};

struct ScheduleResult {
  bool interrupted = false;
  std::size_t done = 0, found_done = 0;
  std::vector<FailedRun> failed;
};

/// True if the member's folder holds its whole run, up to its end.
/// \throws InputError if it holds another case's, or a later end's
bool is_done(const EnsembleMember& member);

/// Whether one of the runs has been begun in its folder.
bool has_begun(const std::vector<ScheduledRun>& runs);

/// What a member says, until it has ended well.
std::filesystem::path output_of(const EnsembleMember& member);

/// The command of a member, the program first, without --resume.
std::vector<std::string> arguments_of(const ScheduledRun& run);

/// What is done, without running anything; members that are not done count as failed. \throws FileError, InputError
ScheduleResult gather_members(const std::vector<ScheduledRun>& runs);

/// Runs what is not done yet, `jobs` at a time, each on one thread, without pictures and reports; a run that was
/// interrupted is resumed. Shows one line of progress with an ETA for the whole. \throws FileError, InputError
ScheduleResult run_members(const std::vector<ScheduledRun>& runs, int jobs);

}  // namespace talus::app
