// SPDX-License-Identifier: Apache-2.0
#include "app/new/kind.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

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
  answer.allowed = fmt::format("a {} {} {}, at most {}, such as {}", dimension_name(question.dimension),
                               question.from_least ? "of at least" : "above", in_unit(question.least),
                               in_unit(question.most), question.standard.empty() ? "none" : question.standard);
  if (question.standard.empty()) answer.allowed = answer.allowed.substr(0, answer.allowed.rfind(", such as"));
  std::string why;
  const auto quantity = parse_quantity(text, &why);
  if (!quantity) {
    answer.what = why;
  } else if (!(quantity->dimension == question.dimension)) {
    answer.what = "is no " + dimension_name(question.dimension);
  } else if (!std::isfinite(quantity->value) || quantity->value > question.most ||
             !(question.from_least ? quantity->value >= question.least : quantity->value > question.least)) {
    answer.what = "is out of range";
  } else {
    answer.value = quantity->value;
  }
  return answer;
}

}  // namespace talus::app
