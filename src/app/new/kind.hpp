// SPDX-License-Identifier: Apache-2.0
/// Cases that talus new writes: what each kind asks, and the case that follows from the answers.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/unit.hpp"

namespace talus::app {

/// A number, or yes or no.
struct Question {
  std::string_view name;      ///< of the option
  std::string_view text;      ///< what it is
  std::string_view standard;  ///< answer if none is given, "40 mm"; empty: there may be none
  Dimension dimension = {};
  double least = 0, most = 1e9;  ///< SI; allowed in between, the least itself only if `from_least`
  bool from_least = false;
  bool is_flag = false;  ///< yes or no; no if not given
};

/// SI, by the names of the questions; 1 and 0 of yes and no; what was not answered is not there.
class Answers {
 public:
  void set(std::string_view name, double value) { values_[std::string(name)] = value; }
  double operator[](std::string_view name) const { return values_.at(std::string(name)); }
  bool has(std::string_view name) const { return values_.contains(std::string(name)); }

 private:
  std::map<std::string, double> values_;
};

struct Kind {
  std::string_view name, text;
  std::span<const Question> questions;
  std::string (*write)(const Answers& answers);  ///< the case's text
};

std::span<const Kind> kinds();

extern const Kind hopper_kind, silo_kind, column_kind, avalanche_kind;

/// Reads one answer. \returns what is wrong and what is allowed in place of it, if it is none
struct Answer {
  std::optional<double> value = {};
  std::string what = {}, allowed = {};
};
Answer read_answer(const Question& question, const std::string& text);

/// A quantity for a case, to five digits: "0.0002 m" is written as "0.2 mm".
std::string written(double value, std::string_view unit);

}  // namespace talus::app
