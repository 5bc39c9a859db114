// SPDX-License-Identifier: Apache-2.0
/// Checkpoints: all that a run needs to continue bitwise identically.
///
/// Two files alternate, checkpoint_a.h5 and checkpoint_b.h5. A new one is written whole under a temporary name and then
/// renamed over the older of the two, so that at any moment, also on a full disk, the newest whole one is there; room
/// for three is needed. A file is HDF5 behind a user block of 512 bytes of text:
///
///     Talus checkpoint / format 1 / sequence 12 / bytes 345678 / crc32 89abcdef      (one per line)
///
/// The sequence number identifies the newer of the two. The checksum covers the lines before it and all bytes of the
/// HDF5 file, and is verified before the library reads them: a torn file and a turned bit are both noticed. Within:
/// /state/NAME, the model's kept fields; anything else by its own path; the attribute "units" on each.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5.hpp"
#include "numerics/field.hpp"

namespace talus {

/// Collects a checkpoint: a visitor for `for_each_field` that takes the kept fields, and named entries next to them.
/// Columns of the state are read when it is saved, all else at the call. Every member throws FileError for a name that
/// is there already.
class CheckpointWriter {
 public:
  /// \param fingerprint of the case
  explicit CheckpointWriter(std::string_view fingerprint);

  /// for_each_field(writer, state)
  template <class T>
  void operator()(const FieldInfo& field, const T& member) {
    if (field.role != FieldRole::kept) return;
    if constexpr (std::is_arithmetic_v<T>)
      put("state/" + std::string(field.name), member, field.unit);
    else
      column(member.size(), source_of({field.name, field.unit, std::span(member)}));
  }
  /// A column of the state.
  void column(std::size_t count, ColumnSource source);

  /// Entries of the run and its observers; names are paths such as "run/rows".
  void put(const std::string& name, const std::vector<double>& values, std::string_view unit = {});
  void put(const std::string& name, const std::vector<Vector3>& values, std::string_view unit = {});
  void put(const std::string& name, const std::vector<std::int64_t>& values, std::string_view unit = {});
  void put(const std::string& name, double value, std::string_view unit = {});
  void put(const std::string& name, std::uint64_t value, std::string_view unit = {});
  void put(const std::string& name, const std::string& text);

 private:
  friend class CheckpointFiles;
  hdf5::Writer file_;
};

/// A whole checkpoint that was read. Members throw FileError, naming the file, where an entry is missing or of another
/// kind.
class CheckpointReader {
 public:
  /// One that was found whole.
  explicit CheckpointReader(const std::filesystem::path& path) : CheckpointReader(hdf5::Reader(path), 0) {}

  /// for_each_field(reader, state): fills the kept fields
  template <class T>
  void operator()(const FieldInfo& field, T& member) const {
    if (field.role != FieldRole::kept) return;
    const std::string name = "state/" + std::string(field.name);
    if constexpr (std::is_arithmetic_v<T>)
      get(name, member);
    else
      get(name, member, field.of_particles ? part_ : std::nullopt);
  }
  /// How many entries a column has.
  std::size_t entries(const std::string& name) const { return file_.describe(name).entries(); }
  /// From here on `for_each_field` gets these entries of the columns of particles alone.
  void take_part(hdf5::Entries part) { part_ = part; }

  void get(const std::string& name, std::vector<double>& values, std::optional<hdf5::Entries> some = {}) const;
  void get(const std::string& name, std::vector<Vector3>& values, std::optional<hdf5::Entries> some = {}) const;
  void get(const std::string& name, std::vector<std::int64_t>& values, std::optional<hdf5::Entries> some = {}) const;
  void get(const std::string& name, double& value) const;
  void get(const std::string& name, std::uint64_t& value) const;
  void get(const std::string& name, std::string& text) const;
  bool has(const std::string& name) const { return file_.has(name); }

  const std::string& fingerprint() const { return fingerprint_; }
  std::uint64_t sequence() const { return sequence_; }
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  friend class CheckpointFiles;
  CheckpointReader(hdf5::Reader file, std::uint64_t sequence);

  hdf5::Reader file_;
  std::optional<hdf5::Entries> part_;
  std::uint64_t sequence_;
  std::string fingerprint_;
};

/// The two files of a run.
class CheckpointFiles {
 public:
  /// Looks at what is there. \param folder the run's; \throws FileError if a file is there but cannot be read
  explicit CheckpointFiles(std::filesystem::path folder);

  static constexpr std::array<std::string_view, 2> names{"checkpoint_a.h5", "checkpoint_b.h5"};

  /// Replaces the older file, or the damaged one. \throws FileError; both files are then as they were
  void save(const CheckpointWriter& checkpoint);

  /// The newest whole checkpoint; nothing if there is none and none was damaged.
  /// \throws FileError if the only ones there are damaged, saying how
  std::optional<CheckpointReader> load() const;

  /// What was found wrong with files that were passed over, for the log; empty if nothing.
  const std::vector<std::string>& damages() const { return damages_; }

 private:
  std::filesystem::path folder_;
  std::array<std::optional<std::uint64_t>, 2> sequences_;  ///< of the whole ones
  std::vector<std::string> damages_;
};

}  // namespace talus
