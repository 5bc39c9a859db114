// SPDX-License-Identifier: Apache-2.0
/// series.csv: one header line with units, "time [s],step_size [s],...", then one row per step, each handed to the
/// system as it is made. Numbers stand in the shortest form that reads back bitwise identical.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/file.hpp"
#include "numerics/run_record.hpp"

namespace talus {

/// Name and unit of a column of a series.
struct SeriesColumn {
  std::string name;
  std::string unit;
};

/// Writes a series. Every member throws FileError with the system's reason; what fails to be written whole is taken
/// back, so that the rows before stay as they are.
class SeriesWriter {
 public:
  /// Starts a new file; one that is there is replaced. No link is followed.
  SeriesWriter(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns);

  /// Goes on after the first `rows` rows of a file; what stands behind them, a half-written line too, is cut off.
  /// \throws FileError also if the file has other columns, or fewer whole rows
  static SeriesWriter resume(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns,
                             std::uint64_t rows);

  /// \param values one per column, in the columns' order; not finite ones are written as nan and inf
  /// \throws std::invalid_argument for another number of values
  void append(std::span<const double> values);

  /// Rows in the file: what a checkpoint remembers and `resume` is given.
  std::uint64_t position() const { return rows_; }

  /// Of the header and these rows (file.hpp).
  std::uint32_t sum() const { return sum_; }

  /// Takes all rows to the disk. To be called before a checkpoint that remembers `position()` is saved.
  void sync() { file_.sync(); }

 private:
  SeriesWriter() = default;

  Descriptor file_;
  std::string line_;
  std::size_t columns_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t rows_ = 0;
  std::uint32_t sum_ = 0;
};

/// The checksum of a series' header and its first `rows` rows. \throws FileError if it has fewer
std::uint32_t checksum_of_series(const std::filesystem::path& path, std::uint64_t rows);

/// Writes a table of such rows, whole or not at all. \param rows of as many values as there are columns
/// \throws FileError, std::invalid_argument
void write_table(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns,
                 const std::vector<std::vector<double>>& rows);

/// Reads a series; a last line without its end (a run in progress, or killed) is left out.
/// \throws FileError if the file cannot be read or a row is not what the header says, with its line
Series read_series(const std::filesystem::path& path);

}  // namespace talus
