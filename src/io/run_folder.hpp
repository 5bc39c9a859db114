// SPDX-License-Identifier: Apache-2.0
/// The folder of a run: where each of its files is, and who may write into it.
///
///     manifest.json  series.csv  checkpoint_a.h5  checkpoint_b.h5  summary.json  report.html  log.txt  stop
///     snapshots/particles.hdf.series  snapshots/particles_0000.vtkhdf  snapshots/air_0000.vtkhdf ...
///     analysis/*.csv  pictures/*.png
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "io/descriptor.hpp"

namespace talus {

/// What to do with a folder that is there and not empty.
enum class Existing {
  refuse,
  resume,    ///< go on with the run in it
  overwrite  ///< remove that run's files, with all tables in analysis/ and all PNGs in pictures/, and no others
};

class RunFolder {
 public:
  /// The folder of a run to read; need not exist.
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// The folder of a run to write: made with its parents if it is not there, and locked against other processes for as
  /// long as a copy of the result lives. Resuming waits two seconds for a run there that has been asked to leave. The
  /// manifest is to be written first: it marks the folder as a run's. A stop file from before is removed. \throws
  /// InputError, before anything is changed, if the folder is not empty and `existing` is refuse; if there is
  ///         no run in it to resume; if it holds files of these names, but not from Talus, that would be overwritten;
  ///         if another process writes there; if it is a file
  /// \throws FileError with the system's reason
  static RunFolder create(std::filesystem::path path, Existing existing);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path manifest() const { return path_ / "manifest.json"; }
  std::filesystem::path series() const { return path_ / "series.csv"; }
  std::filesystem::path summary() const { return path_ / "summary.json"; }
  std::filesystem::path report() const { return path_ / "report.html"; }
  std::filesystem::path log() const { return path_ / "log.txt"; }
  std::filesystem::path stop() const { return path_ / "stop"; }  ///< made by the user to end a run
  std::filesystem::path snapshots() const { return path_ / "snapshots"; }

  /// \param kind "particles" or "air"; \param number >= 0
  std::filesystem::path snapshot(int number, std::string_view kind = "particles") const;

  /// What ParaView is given to open (snapshot_index.hpp).
  std::filesystem::path snapshot_index(std::string_view kind = "particles") const;

  /// Numbers of the snapshots that are there, rising. \throws FileError if the folder cannot be read
  std::vector<int> snapshot_numbers(std::string_view kind = "particles") const;
  std::optional<int> latest_snapshot(std::string_view kind = "particles") const;

 private:
  void lock(Existing existing);
  void remove_run() const;

  std::filesystem::path path_;
  std::shared_ptr<Descriptor> lock_;
};

}  // namespace talus
