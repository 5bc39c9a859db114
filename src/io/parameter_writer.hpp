// SPDX-License-Identifier: Apache-2.0
/// The resolved case: every parameter that means something in it with the value that holds, in SI, whether it was given
/// or is a default.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/case_file.hpp"
#include "io/parameter_value.hpp"

namespace talus {

/// As a case file. It reads back bitwise identical; optional keys without a value are comments.
std::string resolved_case(const ParameterList& list);

/// The keys of such a text and their values as TOML ("\"0.005 s\""); what is not given is not among them.
std::map<std::string, std::string> resolved_values(std::string_view resolved_case);

/// A line of the table that `talus check` prints.
struct ResolvedLine {
  std::string key;
  std::string value;   ///< without its unit: "0.005"; text without quotes; "-" if there is none
  std::string unit;    ///< "m", "deg"; "" for what has none
  std::string origin;  ///< "given", "option" or "default"
  std::string text;    ///< what the parameter is
};
std::vector<ResolvedLine> resolved_table(const ParameterList& list, const CaseFile& file);

/// 16 hexadecimal digits of some bytes: FNV-1a, 64 bits (Fowler, Noll & Vo, draft-eastlake-fnv).
std::string digest(std::string_view bytes);

/// The digest of all keys and values, whatever their order: equal for equal cases however
/// they were written, different for different ones.
/// \param excluded keys, or tables with all their keys, that do not count: "run.end", "output"
std::string fingerprint(const ParameterList& list, std::span<const std::string_view> excluded = {});

// What a case may say, for editors and for people: a JSON Schema and a reference page. Both follow from the lists of
// parameters; the values in the list are the defaults.

/// JSON Schema, draft 2020-12. Tables are objects that allow no other keys; quantities are strings with a pattern (that
/// a number and a unit; the dimension is in the description, and checked when the case is read).
std::string json_schema(const ParameterList& defaults, std::string_view title);

/// Markdown: a heading and a table for each table of the case; columns key, type, unit, allowed, default, meaning.
std::string reference_page(const ParameterList& defaults);

}  // namespace talus
