// SPDX-License-Identifier: Apache-2.0
/// A case as it was written: the values of a TOML file by their dotted keys, each with the line or the option that gave
/// it. What the values mean is ParameterReader's matter.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"

namespace talus {

/// A table; its keys are separate entries.
struct CaseTable {};

/// A date or time, which no parameter takes.
struct CaseDate {
  std::string text;
};

struct CaseValue {
  std::variant<bool, std::int64_t, double, std::string, std::vector<CaseValue>, CaseTable, CaseDate> value;
};

struct CaseEntry {
  /// Dotted: "particles.radius"; parts that are not bare keys are quoted; an array of tables has its numbers from 1:
  /// "plates.1.from"
  std::string key;
  CaseValue value;
  std::string where;       ///< file name, or the option
  int line = 0;            ///< 1-based; 0 for an option
  bool is_option = false;  ///< given by set()
  std::string raw = {};    ///< an option's value as it was written
};

class CaseFile {
 public:
  /// Throws FileError if the file cannot be read, InputError (one problem, with line and column) if it is not TOML.
  static CaseFile read(const std::string& path);

  /// \param name the name of the file in messages
  static CaseFile from_text(std::string_view text, std::string name);

  /// Overrides or adds a value: "particles.count=500", "particles.radius=2 mm". The value is read as TOML if it is
  /// TOML, else it is text. Of several, the last holds. What cannot be read at all is kept in problems(), so that it is
  /// reported together with the rest.
  /// \param option that gave it, for messages
  void set(std::string_view assignment, std::string_view option = "--set");

  /// The same case as if it held these keys, and what lies in these tables, alone.
  CaseFile part(std::span<const std::string_view> keys) const;
  /// The same case as if it did not hold this key.
  CaseFile without(std::string_view key) const;

  const std::string& name() const { return name_; }

  /// In the order of the lines, a table before its keys; options last. No key occurs twice.
  const std::vector<CaseEntry>& entries() const { return entries_; }

  /// Null if the key is not there.
  const CaseEntry* find(std::string_view key) const;
  bool contains(std::string_view key) const { return find(key) != nullptr; }

  /// Number of tables of an array of tables: those under "plates.1", "plates.2", ...
  std::size_t tables(std::string_view key) const;

  /// Faults of options that name no key or no value.
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::string name_;
  std::vector<CaseEntry> entries_;
  std::vector<Problem> problems_;
};

/// Whether `key` lies in `table` or deeper: "a.b" and "a.b.c" lie in "a"; everything lies in "".
bool lies_in(std::string_view key, std::string_view table);

/// "particles" of "particles.radius"; "" of "seed".
std::string_view table_of(std::string_view key);

/// "radius" of "particles.radius".
std::string_view last_part(std::string_view key);

}  // namespace talus
