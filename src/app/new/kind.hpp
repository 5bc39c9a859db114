// SPDX-License-Identifier: Apache-2.0
/// Cases that talus new writes: what each kind asks, and the case that follows from the answers.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/unit.hpp"

namespace talus::app {

inline constexpr double drafted_gravity = 9.81;  ///< gravity.acceleration of every draft, m/s2

/// A number, a word, or yes or no.
struct Question {
  std::string_view name;      ///< of the option
  std::string_view text;      ///< what it is
  std::string_view standard;  ///< answer if none is given, "40 mm"; empty: there may be none
  Dimension dimension = {};
  double min = 0, max = 1e9;  ///< SI; allowed in between, the minimum itself only if `from_min`
  bool from_min = false;
  bool is_flag = false;                          ///< yes or no; no if not given
  std::span<const std::string_view> words = {};  ///< that may be the answer in place of a number
  bool only_words = false;
};

/// Numbers in SI and words, by the names of the questions; 1 and 0 of yes and no; what was not answered is not there.
class Answers {
 public:
  void set(std::string_view name, double value) { values_[std::string(name)] = value; }
  void set(std::string_view name, std::string word) { words_[std::string(name)] = std::move(word); }
  double operator[](std::string_view name) const { return values_.at(std::string(name)); }
  const std::string& word(std::string_view name) const { return words_.at(std::string(name)); }
  bool has(std::string_view name) const { return values_.contains(std::string(name)); }
  bool has_word(std::string_view name) const { return words_.contains(std::string(name)); }

 private:
  std::map<std::string, double> values_;
  std::map<std::string, std::string> words_;
};

/// A key of the case and the question whose answer it takes. \ref key may lack the tables before it: "lower_radius".
struct KeyOfAnswer {
  std::string_view key, question;
};

struct Kind {
  std::string_view name, text;
  std::span<const Question> questions;
  std::string (*write)(const Answers& answers);  ///< the case's text
  std::span<const KeyOfAnswer> keys = {};
  std::string_view sketch = {};  ///< which length is which
  /// Answers that contradict each other; `key` is the question. Null: none do.
  std::vector<Problem> (*check)(const Answers& answers) = nullptr;
};

/// The errors of a case that was not written, as errors of the answers behind it: in place of lines and
/// keys they name options. \param texts the answers as they were given, by the names of the questions
std::vector<Problem> by_option(const Kind& kind, const std::map<std::string, std::string>& texts,
                               std::vector<Problem> problems);

std::span<const Kind> kinds();

extern const Kind hopper_kind, silo_kind, column_kind, avalanche_kind;

/// Reads one answer. \returns what is wrong and what is allowed in place of it, if it is none
struct Answer {
  std::optional<double> value = {};
  std::optional<std::string> word = {};
  std::string what = {}, allowed = {}, nearest = {};
};
Answer read_answer(const Question& question, const std::string& text);

/// A quantity for a case, to five digits: "0.0002 m" is written as "0.2 mm".
std::string written(double value, std::string_view unit);

}  // namespace talus::app
