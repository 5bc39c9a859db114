// SPDX-License-Identifier: Apache-2.0
/// The little of HDF5 that Talus needs: files written and read, with columns, numbers and texts. Failures are
/// exceptions that carry the library's own reason; the library prints nothing.
///
/// The library builds files in memory (a file of tmpfs), because a disk that fills up while it writes leaves it with a
/// file that it can neither finish nor close. Columns that are read piece by piece have room in that file which takes
/// no memory; what goes to the disk, in order and once, is the file with their pieces in that room. What particles have
/// is not compressed: digits of positions and velocities are noise, and deflate with shuffle takes 4 times as long as
/// writing to save a third. What repeats, as the loads of fields on many triangles each, is.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vector.hpp"
#include "io/file.hpp"
#include "numerics/snapshot.hpp"

namespace talus::hdf5 {

/// An identifier of the library and how it is closed.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  hid_t id() const { return id_; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// How columns lie in a file.
enum class Storage { plain, deflated };

/// A file being built. Names are paths ("PointData/radius"); groups on the way are made. Units go into the
/// attribute "units" of each data set. The same calls give the same bytes: no times are recorded.
/// \throws FileError, from every member, naming the file it is meant for
class Writer {
 public:
  /// \param path the file it is meant for; used in messages only \param storage of the columns of one piece and more
  explicit Writer(std::filesystem::path path, Storage storage = Storage::plain);

  void group(const std::string& name);
  /// Columns of n, n x 3, n and n entries.
  void write(const std::string& name, std::span<const double> values, std::string_view unit = {});
  void write(const std::string& name, std::span<const Vector3> values, std::string_view unit = {});
  void write(const std::string& name, std::span<const std::int64_t> values, std::string_view unit = {});
  void write(const std::string& name, std::span<const std::uint8_t> values);
  /// A column of so many entries, which is read when the file is taken to the disk; at once if it is deflated.
  void write(const std::string& name, std::size_t count, ColumnSource source);
  /// Cells of a grid, in single precision: nz x ny x nx, or nz x ny x nx x 3. \param shape nz, ny, nx
  void write_grid(const std::string& name, const std::array<std::size_t, 3>& shape, std::span<const double> values,
                  std::string_view unit);
  void write_grid(const std::string& name, const std::array<std::size_t, 3>& shape, std::span<const Vector3> values,
                  std::string_view unit);
  /// Single numbers (no dimensions).
  void write(const std::string& name, double value, std::string_view unit = {});
  void write(const std::string& name, std::uint64_t value, std::string_view unit = {});
  void write(const std::string& name, std::string_view text);

  void attribute(const std::string& object, const char* name, std::string_view text);
  void attribute(const std::string& object, const char* name, std::span<const std::int64_t> values);
  void attribute(const std::string& object, const char* name, std::span<const double> values);

  /// The length of the finished file; nothing is added to it then.
  std::size_t bytes() const;
  /// Hands over the finished file, from its first byte to the last, once.
  void each_piece(const std::function<void(std::string_view piece)>& take) const;
  /// Writes it to the path. \throws FileError as write_atomically
  void save() const;

 private:
  struct Later {
    std::size_t at, count;  // byte of the file, entries
    ColumnSource source;
  };
  void attribute_raw(const std::string& object, const char* name, hid_t type, std::size_t count, const void* values);
  /// \param values none: they come later
  Handle write_raw(const std::string& name, hid_t type, std::span<const hsize_t> shape, const void* values,
                   std::string_view unit);

  std::filesystem::path path_;
  Storage storage_;
  Descriptor memory_;
  Handle file_;
  std::vector<Later> later_;
};

/// What a data set holds.
struct Description {
  enum class Kind { real, integer, text, other } kind;
  std::vector<std::size_t> shape;  ///< empty: a single number
  std::size_t element_bytes;
  bool is_signed;  ///< of integers

  std::size_t entries() const { return shape.empty() ? 1 : shape[0]; }
  std::size_t components() const { return shape.size() < 2 ? 1 : shape[1]; }
};

/// Some entries of a column.
struct Entries {
  std::size_t first, count;
};

/// A file to read.
/// \throws FileError, from every member, naming the file
class Reader {
 public:
  /// Opens a file. \throws FileError if it cannot be opened or is not a (whole) HDF5 file
  explicit Reader(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  bool has(const std::string& name) const;
  /// Names of the members of a group, sorted. \param group "/" is the file itself
  std::vector<std::string> names(const std::string& group) const;
  Description describe(const std::string& name) const;

  /// Entries in the file's order, converted to the type asked for: all, or some of a column.
  std::vector<double> doubles(const std::string& name, std::optional<Entries> some = {}) const;
  std::vector<Vector3> vectors(const std::string& name, std::optional<Entries> some = {}) const;  ///< of n x 3
  std::vector<std::int64_t> integers(const std::string& name, std::optional<Entries> some = {}) const;
  std::uint64_t number(const std::string& name) const;
  std::string text(const std::string& name) const;

  /// \returns "" if there is no such attribute
  std::string text_attribute(const std::string& object, const char* name) const;
  /// \returns nothing if there is no such attribute
  std::vector<std::int64_t> integer_attribute(const std::string& object, const char* name) const;
  std::vector<double> real_attribute(const std::string& object, const char* name) const;

 private:
  template <class Number>
  std::vector<Number> attribute(const std::string& object, const char* name, hid_t type) const;
  template <class Entry>
  std::vector<Entry> read(const std::string& name, hid_t type, std::optional<Entries> some) const;
  void read_raw(const std::string& name, hid_t type, void* values, std::optional<Entries> some = {}) const;
  Handle open(const std::string& name) const;

  std::filesystem::path path_;
  Handle file_;
};

}  // namespace talus::hdf5
