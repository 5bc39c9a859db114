// SPDX-License-Identifier: Apache-2.0
#include "app/new/kind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

namespace talus::app {

std::span<const Kind> kinds() {
  static const std::array<Kind, 4> all = {hopper_kind, silo_kind, column_kind, avalanche_kind};
  return all;
}

std::string written(double value, std::string_view unit) {
  const auto one = parse_quantity(unit.empty() ? "1" : "1 " + std::string(unit));
  return fmt::format("\"{:.5g} {}\"", value / one.value().value, unit);
}

Answer read_answer(const Question& question, const std::string& text) {
  const auto in_unit = [&](double value) {
    const std::string unit = example_unit(question.dimension);
    const double one = unit.empty() ? 1 : parse_quantity("1 " + unit).value().value;
    return fmt::format("{:g}{}{}", value / one, unit.empty() ? "" : " ", unit);
  };
  Answer answer;
  const std::string name = dimension_name(question.dimension);
  const std::string kind =
      (std::string_view("aeiou").find(name.front()) == std::string_view::npos ? "a " : "an ") + name;
  answer.allowed =
      fmt::format("{} {} {}, at most {}, such as {}", kind, question.from_min ? "of at least" : "above",
                  in_unit(question.min), in_unit(question.max), question.standard.empty() ? "none" : question.standard);
  if (question.standard.empty() || !question.words.empty())
    answer.allowed = answer.allowed.substr(0, answer.allowed.rfind(", such as"));
  if (!question.words.empty())
    answer.allowed = fmt::format("{}{}{}", fmt::join(question.words, ", "), question.only_words ? "" : ", or ",
                                 question.only_words ? "" : answer.allowed);
  if (std::find(question.words.begin(), question.words.end(), text) != question.words.end()) {
    answer.word = text;
    return answer;
  }
  if (question.only_words) {
    answer.what = "is not known";
    answer.nearest = nearest(text, question.words);
    return answer;
  }
  std::string why;
  const auto quantity = parse_quantity(text, &why);
  if (!quantity) {
    answer.what = why;
  } else if (!(quantity->dimension == question.dimension)) {
    answer.what = "is not " + kind;
  } else if (!std::isfinite(quantity->value) || quantity->value > question.max ||
             !(question.from_min ? quantity->value >= question.min : quantity->value > question.min)) {
    answer.what = "is out of range";
  } else {
    answer.value = quantity->value;
  }
  return answer;
}

std::vector<Problem> by_option(const Kind& kind, const std::map<std::string, std::string>& texts,
                               std::vector<Problem> problems) {
  for (Problem& problem : problems) {
    const auto found = std::find_if(kind.keys.begin(), kind.keys.end(), [&](const KeyOfAnswer& k) {
      return problem.key == k.key || problem.key.ends_with("." + std::string(k.key));
    });
    const std::string_view question = found == kind.keys.end() ? std::string_view(problem.key) : found->question;
    const auto asked = std::find_if(kind.questions.begin(), kind.questions.end(),
                                    [&](const Question& q) { return q.name == question; });
    problem.line = problem.column = 0;
    for (const KeyOfAnswer& k : kind.keys)
      for (std::string* text : {&problem.what, &problem.allowed})
        if (const auto at = text->find(k.key); at != std::string::npos && k.key.find('.') != std::string_view::npos)
          text->replace(at, k.key.size(), "--" + std::string(k.question));
    if (asked == kind.questions.end()) {
      problem.where = fmt::format("talus new {}", kind.name);
      continue;
    }
    const auto text = texts.find(std::string(question));
    const std::string given =
        text != texts.end() && !text->second.empty() ? text->second : std::string(asked->standard);
    problem.where = fmt::format("--{}{}{}", question, given.empty() ? "" : " ", given);
    problem.key.clear();
  }
  return problems;
}

}  // namespace talus::app
