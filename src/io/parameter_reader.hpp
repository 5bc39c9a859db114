// SPDX-License-Identifier: Apache-2.0
/// From a case file to typed parameters. A reader visits the lists of parameters that a case consists of, gathers
/// every fault, and throws once:
///
///     ParameterReader reader(case_file);
///     for_each_parameter(reader, model_parameters);
///     for_each_parameter(reader, run_parameters);
///     reader.check(check(model_parameters));
///     reader.finish();
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "io/case_file.hpp"
#include "io/parameter_value.hpp"

namespace talus {

class ParameterReader {
 public:
  /// \param file outlives the reader; \param renamed former keys, to report the new ones
  explicit ParameterReader(const CaseFile& file, std::span<const RenamedKey> renamed = {});

  /// Reads one parameter. The member keeps its initial value if the key is missing or faulty, or where its condition
  /// fails. There a key that is given is a fault, unless it stands in the file and an option has taken another choice:
  /// then it belongs to the choice that was replaced.
  template <class T>
  void operator()(const Parameter& parameter, T& member) {
    if (const auto value = read(parameter, value_type<T>())) from_value(*value, member);
  }

  /// Adds contradictions between parameters: `key` and `what` are given, the line is looked up. One whose key, or a key
  /// that its words name, is already known to be faulty is dropped: it would be a consequence.
  void check(std::vector<Problem> contradictions);

  /// Looks for keys that no parameter has, and throws one InputError with every problem there is: by line, then what
  /// is missing, then the options.
  void finish();

  /// As finish(), but keys not visited may be there: for what must be known before the lists are, such as the model.
  void throw_problems() const;

 private:
  struct Found {
    Problem problem;
    bool is_missing = false;  // the key is not in the file
    bool is_option = false;
  };

  std::optional<ParameterValue> read(const Parameter& parameter, const ValueType& type);
  void add(const CaseEntry& entry, std::string what, std::string allowed, std::string nearest = {});
  bool is_table(std::string_view key) const;
  void report_unknown_keys();
  void report_unknown_table(const CaseEntry& table, const std::vector<const CaseEntry*>& keys);
  void report_unknown_key(const CaseEntry& entry);
  bool report_renamed_key(const CaseEntry& entry);

  const CaseFile& file_;
  std::span<const RenamedKey> renamed_;
  std::vector<std::string> keys_;  // of the parameters visited, in their order
  std::vector<Found> found_;
  std::set<std::string, std::less<>> meant_;  // keys that unknown ones were meant to be
};

}  // namespace talus
