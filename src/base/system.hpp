// SPDX-License-Identifier: Apache-2.0
/// The machine and this program: available memory and disk, other programs, version.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace talus {

/// Bytes: the least of what the system has free for new programs, what the control group of the process (a container, a
/// batch system's job) leaves, and what its limit on address space (`ulimit -v`) does. Nothing if unknown.
std::optional<double> available_memory();

/// Bytes that can be written to the file system of a folder, or of the nearest folder above it that exists; nothing
/// where that cannot be said.
std::optional<double> available_disk(const std::filesystem::path& folder);

/// Processor time of this program until now, of all its threads, s.
double processor_seconds();

/// Processors of this machine, at least 1.
int processors();

/// Processor time that the calling thread has taken, s.
double processor_seconds_of_thread();

/// Adds the processor time that its thread takes while it lives to a sum, s.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += processor_seconds_of_thread() - began_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  double began_ = processor_seconds_of_thread();
};

/// The programs of this name (ffmpeg, sbatch, python3) in the folders of PATH that may be executed, in the order of the
/// folders. An empty entry of PATH is passed over: what lies in the current folder is not run. Without a PATH, those of
/// the system's own.
std::vector<std::filesystem::path> find_programs(std::string_view name);

/// The first of them.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// "0.2.0", from project() in CMakeLists.txt
std::string_view program_version();

/// The commit it was built from, with "-dirty" if tracked files differed from it; "unknown" outside a repository.
std::string_view program_revision();

/// "GCC 12.2.0"
std::string_view program_compiler();

}  // namespace talus
