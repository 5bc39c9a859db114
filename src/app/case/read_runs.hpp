// SPDX-License-Identifier: Apache-2.0
/// Runs that have been read. Tables, pictures and comparisons of a run are handed the same ones, so that its series is
/// read once and the numbers of its snapshots are made once. Valid while nobody goes on with these runs.
#pragma once

#include <any>
#include <filesystem>
#include <map>
#include <utility>

namespace talus::app {

class ReadRuns {
 public:
  /// The run in a folder: read() gives it when it is first asked for. \throws what read() and std::filesystem throw;
  /// std::bad_any_cast if it was read as another kind of run
  template <class Run, class Read>
  const Run& of(const std::filesystem::path& folder, Read&& read) {
    std::any& run = runs_[std::filesystem::canonical(folder)];
    if (!run.has_value()) run = Run(std::forward<Read>(read)());
    return std::any_cast<const Run&>(run);
  }

 private:
  std::map<std::filesystem::path, std::any> runs_;
};

}  // namespace talus::app
