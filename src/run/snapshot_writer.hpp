// SPDX-License-Identifier: Apache-2.0
/// The snapshots of a run: when one is due, its files, and their checksums, which the checkpoint keeps.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "io/run_folder.hpp"
#include "run/any_model.hpp"

namespace talus::run {

class SnapshotWriter {
 public:
  /// \param interval simulated time between snapshots, s, > 0
  SnapshotWriter(const std::filesystem::path& folder, double interval) : folder_(folder), interval_(interval) {}

  bool is_due(double time) const { return time >= next_time_; }

  /// Of the state as it is. \throws FileError
  void take(const AnyModel& model);

  /// The state at the end, where it falls between two snapshots: written, but not counted, since a later end takes the
  /// number. \throws FileError
  void take_last(const AnyModel& model);

  void save(CheckpointWriter& checkpoint) const;

  /// Goes on behind a checkpoint: snapshots made after it are removed, and the indices are rebuilt from the files.
  /// \throws FileError
  void resume(const CheckpointReader& checkpoint);

 private:
  void write(const AnyModel& model);
  void keep_sum(std::size_t kind, const std::filesystem::path& path);

  RunFolder folder_;
  double interval_;
  std::uint64_t taken_ = 0;
  std::uint64_t step_ = 0;  ///< of the last one
  double next_time_ = 0;
  std::array<std::vector<std::int64_t>, 3> sums_;  ///< of particles, air and walls, by number
};

/// What a run's files are, compared with its newest whole checkpoint.
struct FilesFound {
  bool has_sums = false;             ///< no, where a version of Talus wrote the run that kept none
  std::size_t compared = 0;          ///< series.csv and snapshots
  std::vector<std::string> changed;  ///< not as they were written, each with its path
  std::vector<std::string> missing;  ///< paths
};

/// Compares the series up to the checkpoint, and the snapshots that it counts, with the checksums that it holds.
/// \param ended whether the run has: the snapshot of its last state, which a later end replaces, is compared too, and
/// the series has no more rows
/// \throws FileError if a file cannot be read
FilesFound compare_files(const RunFolder& folder, const CheckpointReader& checkpoint, bool ended);

}  // namespace talus::run
