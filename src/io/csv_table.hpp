// SPDX-License-Identifier: Apache-2.0
/// A table of numbers as comma-separated values: a header line that names the columns with their units, then lines.
///
///     duration [ms],gradient_zz [1/s]
///     10,-0.02
///
/// Blank lines, blanks around entries, a byte order mark and line ends of either kind are taken. A header without a
/// comma may separate columns by semicolons or tabs, as instruments export them; numbers then may have decimal commas,
/// if none of the file has a decimal point.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/unit.hpp"

namespace talus {

/// A column that means a quantity of a known dimension; without a unit its entries are SI.
struct KnownColumn {
  std::string_view name;
  Dimension dimension;
};

/// Another name of a known column, whose entries are multiples of it: a diameter is twice a radius.
struct ColumnAlias {
  std::string_view name, means;
  double factor = 1;  ///< a power of two: the multiplication is exact
};

/// A column that may not be there, because it shows that something else was expected.
struct RefusedColumn {
  std::string_view name, why;
};

struct CsvFormat {
  std::span<const KnownColumn> known = {};
  std::span<const ColumnAlias> aliases = {};
  std::span<const RefusedColumn> refused = {};
  std::span<const std::string_view> required = {};  ///< columns that must be there
  bool known_only = false;                          ///< whether other columns are faults
  bool needs_units = false;                         ///< whether a known column without its unit is a fault
  std::string_view header = {};                     ///< an example of one, for messages
};

struct CsvColumn {
  std::string name;
  std::string unit;            ///< SI; "1" for numbers, "rad" for angles
  std::vector<double> values;  ///< SI, each the double nearest to what is written
  bool has_unit = false;       ///< whether the header gives one
};

struct CsvTable {
  std::vector<CsvColumn> columns;  ///< at least one, all of the same length
  std::vector<int> lines;          ///< of each row in the file, 1-based

  /// Null if there is none of that name.
  const CsvColumn* find(std::string_view name) const;
};

/// \throws FileError if the file cannot be read
/// \throws InputError with every bad line, or the first 20 and their count: entries that are missing, no numbers, not
///         finite or too large, decimal points beside commas, and columns that are missing, given twice, unknown,
///         without the unit that they need or in one that does not fit
CsvTable read_csv_table(const std::filesystem::path& path, const CsvFormat& format);

}  // namespace talus
