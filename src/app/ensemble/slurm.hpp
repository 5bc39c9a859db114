// SPDX-License-Identifier: Apache-2.0
/// The members of an ensemble as an array job of Slurm, one task each, and a job after them that gathers.
/// Source: Slurm 22.05, "Job Array Support", https://slurm.schedmd.com/job_array.html
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/ensemble/schedule.hpp"

namespace talus::app {

struct SlurmRequest {
  std::filesystem::path folder;           ///< of the ensemble
  std::vector<ScheduledRun> members;      ///< those that are to run, at least one
  std::vector<std::string> gather;        ///< the command that gathers, the program first
  std::optional<int> at_once = {};        ///< tasks at a time; none: as Slurm likes
  std::vector<std::string> options = {};  ///< of sbatch, for the members: "--time=2:00:00"
};

/// \throws InputError if an option is none of sbatch, or the folder's path has a control character or a quotation mark
void check_slurm(const std::vector<std::string>& options, const std::filesystem::path& folder);

/// Writes FOLDER/slurm/members.sh (the array job), gather.sh (the job after it) and submit.sh (what submits both), and
/// returns the path of the last one. A task whose folder is there resumes, so that a task may be requeued; Slurm tells
/// it two minutes before its limit of time, and it leaves with a checkpoint.
/// \throws InputError as check_slurm(), FileError
std::filesystem::path write_slurm(const SlurmRequest& request);

/// Runs submit.sh, where there is sbatch. \returns what it said; nothing where there is no sbatch
/// \throws FileError if sbatch refuses, with what it said
std::optional<std::string> submit_slurm(const std::filesystem::path& submit);

/// A word as bash reads it back.
std::string shell_word(const std::string& word);

}  // namespace talus::app
