// SPDX-License-Identifier: Apache-2.0
/// The folder of a run: where each of its files is, and who may write into it.
///
///     manifest.json  series.csv  checkpoint_a.h5  checkpoint_b.h5  summary.json  report.html  log.txt  stop
///     files.txt (what of these Talus wrote: file_list.hpp)
///     snapshots/particles.hdf.series  snapshots/particles_0000.vtkhdf ...
///     snapshots/air.hdf.series        snapshots/air_0000.vtkhdf ...        the same of walls
///     analysis/*.csv  pictures/*.png
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "io/file.hpp"
#include "io/file_list.hpp"

namespace talus {

class RunFolder {
 public:
  /// The folder of a run to read; need not exist.
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// The folder of a run to write: made with its parents if it is not there, and locked against other processes for as
  /// long as a copy of the result lives. Resuming waits two seconds for a run there that has been asked to leave. The
  /// manifest is to be written first: it marks the folder as a run's. A stop file from before is removed. The folder
  /// itself may be reached through a link; within it none is followed.
  /// \throws InputError, before anything is changed, if the folder is not empty and `existing` is refuse; if there is
  ///         no run in it to resume; if it keeps no list of what was written, or holds files of these names that are
  ///         not in it, and is to be overwritten; if one of them or of its folders is a symbolic link; if another
  ///         process writes there; if it is a file
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

  /// \param kind "particles", "air" or "walls"; \param number >= 0
  std::filesystem::path snapshot(int number, std::string_view kind = "particles") const;

  /// What ParaView is given to open (run_json.hpp).
  std::filesystem::path snapshot_index(std::string_view kind = "particles") const;

  /// Numbers of the snapshots that are there, rising; where the folder keeps a list of what Talus wrote, of those in
  /// it. \throws FileError if the folder cannot be read
  std::vector<int> snapshot_numbers(std::string_view kind = "particles") const;
  /// Removes the snapshots with this number and above that the list names: a resumed run makes them again.
  /// \returns whether there were any \throws FileError
  bool remove_snapshots(int first, std::string_view kind = "particles") const;

 private:
  void lock(Existing existing);

  std::filesystem::path path_;
  std::shared_ptr<Descriptor> lock_;
};

}  // namespace talus
