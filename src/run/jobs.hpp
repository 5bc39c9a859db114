// SPDX-License-Identifier: Apache-2.0
/// Independent runs as separate processes: a crash of one does not affect the others, and the folder of each is that of
/// an ordinary run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace talus::run {

struct Job {
  std::vector<std::string> arguments;  ///< the program's path first
  std::filesystem::path output;        ///< file that takes stdout and stderr, replaced
};

struct JobEnd {
  std::size_t job = 0;
  int status = 0;  ///< exit status; 128 + signal if it was killed
  double seconds = 0;
};

/// Runs all jobs, at most `at_once` at a time, in their order. A job whose parent dies gets SIGTERM. When `interrupted`
/// becomes true no further job is begun, those that run get SIGTERM, and their ends are waited for.
/// \param on_end called in this thread as jobs end, in the order in which they do
/// \param on_wait called often in between
/// \returns false if interrupted
/// \throws FileError if a process or its output file cannot be made; the others have ended then
bool run_jobs(const std::vector<Job>& jobs, int at_once, const std::function<void(const JobEnd&)>& on_end,
              const std::function<void()>& on_wait, const std::function<bool()>& interrupted);

struct ProgramEnd {
  int status = 0;              ///< as of a job
  std::string output, errors;  ///< stdout and stderr
};

/// Runs a program with `input` as its stdin. When `interrupted` becomes true it gets SIGTERM, and its end is waited
/// for. \param arguments the program's path first \throws FileError if the process cannot be made
ProgramEnd run_program(const std::vector<std::string>& arguments, const std::string& input,
                       const std::function<bool()>& interrupted);

/// The path of the running program, to start it again.
std::string own_program();

}  // namespace talus::run
