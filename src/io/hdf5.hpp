// SPDX-License-Identifier: Apache-2.0
/// The little of HDF5 that Talus needs: files built in memory and files read, with columns, numbers and texts. Failures
/// are exceptions that carry the library's own reason; the library prints nothing.
///
/// Files are built in memory (the library's core driver), because a disk that fills up while the library writes leaves
/// it with a file that it can neither finish nor close; `write_atomically` takes the finished image to the disk. The
/// price is memory for two copies of a file while it is written. Nothing is compressed: digits of positions and
/// velocities are noise, and deflate with shuffle takes 4 times as long as writing to save a third.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vector.hpp"

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

/// A file being built in memory. Names are paths ("PointData/radius"); groups on the way are made. Units go into the
/// attribute "units" of each data set. The same calls give the same bytes: no times are recorded.
/// \throws FileError, from every member, naming the file it is meant for
class Writer {
 public:
  /// \param path the file it is meant for; used in messages only
  explicit Writer(std::filesystem::path path);

  void group(const std::string& name);
  /// Columns of n, n x 3, n and n entries.
  void write(const std::string& name, std::span<const double> values, std::string_view unit = {});
  void write(const std::string& name, std::span<const Vector3> values, std::string_view unit = {});
  void write(const std::string& name, std::span<const std::int64_t> values, std::string_view unit = {});
  void write(const std::string& name, std::span<const std::uint8_t> values);
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

  /// The finished file.
  /// \param front bytes left free before it (they hold '\0')
  std::string image(std::size_t front = 0) const;

 private:
  void attribute_raw(const std::string& object, const char* name, hid_t type, std::size_t count, const void* values);
  void write_raw(const std::string& name, hid_t type, std::span<const hsize_t> shape, const void* values,
                 std::string_view unit);

  std::filesystem::path path_;
  Handle file_;
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

/// A file to read.
/// \throws FileError, from every member, naming the file
class Reader {
 public:
  /// Opens a file. \throws FileError if it cannot be opened or is not a (whole) HDF5 file
  explicit Reader(std::filesystem::path path);
  /// Reads from an image in memory, which is copied. \param path used in messages only
  Reader(std::string_view image, std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  bool has(const std::string& name) const;
  /// Names of the members of a group, sorted. \param group "/" is the file itself
  std::vector<std::string> names(const std::string& group) const;
  Description describe(const std::string& name) const;

  /// All entries in the file's order, converted to the type asked for.
  std::vector<double> doubles(const std::string& name) const;
  std::vector<Vector3> vectors(const std::string& name) const;  ///< of n x 3
  std::vector<std::int64_t> integers(const std::string& name) const;
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
  void read_raw(const std::string& name, hid_t type, void* values) const;
  Handle open(const std::string& name) const;

  std::filesystem::path path_;
  Handle file_;
};

}  // namespace talus::hdf5
