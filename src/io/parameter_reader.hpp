// SPDX-License-Identifier: Apache-2.0
/// From a case file to typed parameters. A reader visits the lists of parameters that a case consists of, gathers
/// every fault, and throws once:
///
///     ParameterReader reader(case_file);
///     for_each_parameter(reader, model_parameters);
///     for_each_parameter(reader, run_parameters);
///     reader.check(model_parameters, [](const ModelParameters& p) { return check(p); });
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

  /// The same, with the contradictions that contradictions_of(parameters) finds. To be called when all lists have been
  /// visited. A parameter that is missing, faulty or misspelt has a value that nobody has given: a contradiction counts
  /// only if it stays, word for word, when such parameters take several other values.
  /// \param contradictions_of takes any values within the parameters' ranges
  template <class Parameters, class Contradictions>
  void check(const Parameters& parameters, const Contradictions& contradictions_of) {
    report_unknown_keys();
    std::vector<Problem> contradictions = contradictions_of(parameters);
    for (int trial = 0; trial < trials && !contradictions.empty() && has_unread(); ++trial) {
      Parameters others = parameters;
      const auto replace = [&]<class T>(const Parameter& parameter, T& member) {
        if (is_unread(parameter.key)) from_value(trial_value(parameter, value_type<T>(), trial), member);
      };
      for_each_parameter(replace, others);
      keep_common(contradictions, contradictions_of(others));
    }
    check(std::move(contradictions));
  }

  /// Throws one InputError with every problem there is, keys that no parameter has included: by line, then what is
  /// missing, then the options.
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
  bool has_unread() const;
  bool is_unread(std::string_view key) const;
  static void keep_common(std::vector<Problem>& problems, const std::vector<Problem>& others);
  void report_unknown_keys();
  void report_unknown_table(const CaseEntry& table, const std::vector<const CaseEntry*>& keys);
  void report_unknown_key(const CaseEntry& entry);
  bool report_renamed_key(const CaseEntry& entry);

  static constexpr int trials = 4;

  const CaseFile& file_;
  std::span<const RenamedKey> renamed_;
  std::vector<std::string> keys_;  // of the parameters visited, in their order
  std::vector<Found> found_;
  std::set<std::string, std::less<>> meant_;  // keys that unknown ones were meant to be
  bool knows_unknown_keys_ = false;           // whether they are reported already
};

}  // namespace talus
