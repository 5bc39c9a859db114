// SPDX-License-Identifier: Apache-2.0
/// Runs that have been read. Tables, pictures and comparisons of a run are handed the same ones, so that its series is
/// read once and the numbers of its snapshots are made once. Valid while nobody goes on with these runs.
#pragma once

#include <any>
#include <cstddef>
#include <filesystem>
#include <map>
#include <utility>

namespace talus::app {

class ReadRuns {
 public:
  /// At the end of a run, whose numbers are made snapshot by snapshot, and in a comparison, whose rows ask for the same
  /// snapshots again and again.
  static constexpr std::size_t one_by_one = 16'000'000, many_times = 256'000'000;

  /// \param snapshot_memory bytes of a run's snapshots that are kept in memory while they are measured, about
  explicit ReadRuns(std::size_t snapshot_memory = one_by_one) : snapshot_memory_(snapshot_memory) {}
  std::size_t snapshot_memory() const { return snapshot_memory_; }

  /// The run in a folder: read() gives it when it is first asked for. \throws what read() and std::filesystem throw;
  /// std::bad_any_cast if it was read as another kind of run
  template <class Run, class Read>
  const Run& of(const std::filesystem::path& folder, Read&& read) {
    return kept<Run>(runs_[std::filesystem::canonical(folder)], std::forward<Read>(read));
  }

  /// The case of the run in a folder, in the same way.
  template <class Case, class Read>
  const Case& case_of(const std::filesystem::path& folder, Read&& read) {
    return kept<Case>(cases_[std::filesystem::canonical(folder)], std::forward<Read>(read));
  }
  /// Null where it has not been read. A comparison of many runs need not keep the cases of all.
  template <class Case>
  const Case* find_case(const std::filesystem::path& folder) const {
    const auto found = cases_.find(std::filesystem::canonical(folder));
    return found == cases_.end() ? nullptr : std::any_cast<Case>(&found->second);
  }
  /// It is that one, read before the run. \param read a Case; empty: not kept
  void keep_case(const std::filesystem::path& folder, std::any read) {
    if (read.has_value()) cases_[std::filesystem::canonical(folder)] = std::move(read);
  }

 private:
  template <class Kept, class Read>
  static const Kept& kept(std::any& value, Read&& read) {
    if (!value.has_value()) value = Kept(std::forward<Read>(read)());
    return std::any_cast<const Kept&>(value);
  }

  std::size_t snapshot_memory_;
  std::map<std::filesystem::path, std::any> runs_, cases_;
};

}  // namespace talus::app
