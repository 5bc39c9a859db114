// SPDX-License-Identifier: Apache-2.0
#include "io/convert_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/nearest.hpp"
#include "base/unit.hpp"

namespace talus {

namespace {

class Converter {
 public:
  Converter(const Parameter& parameter, const ValueType& type, ValueFault& fault)
      : parameter_(parameter), type_(type), fault_(fault) {}

  std::optional<ParameterValue> convert(const CaseEntry& entry) {
    if (type_.shape != ValueType::Shape::one) return wrap(numbers(entry.value));
    switch (type_.kind) {
      case ValueType::Kind::number:
        return wrap(number(entry.value));
      case ValueType::Kind::integer:
        return wrap(integer(entry.value));
      case ValueType::Kind::flag:
        if (const bool* flag = std::get_if<bool>(&entry.value.value)) return *flag;
        return wrong_type(entry.value);
      case ValueType::Kind::text:
        if (const auto* text = std::get_if<std::string>(&entry.value.value)) return *text;
        if (entry.is_option && !entry.raw.empty()) return entry.raw;  // --set title=2024
        return wrong_type(entry.value);
      case ValueType::Kind::choice:
        return wrap(choice(entry.value));
    }
    return std::nullopt;
  }

 private:
  template <class T>
  static std::optional<ParameterValue> wrap(std::optional<T> value) {
    if (!value) return std::nullopt;
    return ParameterValue{std::move(*value)};
  }

  std::nullopt_t fail(std::string what, std::string nearest = {}) {
    fault_ = {std::move(what), std::move(nearest)};
    return std::nullopt;
  }

  std::nullopt_t wrong_type(const CaseValue& value) {
    if (const auto* text = std::get_if<std::string>(&value.value)) {
      const auto number = parse_quantity(*text);
      const bool meant = type_.kind == ValueType::Kind::flag ? *text == "true" || *text == "false"
                                                             : number && number->dimension == dimension::none;
      if (meant) return fail(fmt::format("{} is text; write it without quotes", as_written(value)));
    }
    return fail(fmt::format("{} is not {}", as_written(value), type_text(parameter_, type_)));
  }

  std::optional<double> number(const CaseValue& value) {
    std::optional<double> result;
    if (const auto* text = std::get_if<std::string>(&value.value))
      result = quantity(*text);
    else if (const auto* whole = std::get_if<std::int64_t>(&value.value))
      result = plain(static_cast<double>(*whole), value);
    else if (const auto* real = std::get_if<double>(&value.value))
      result = plain(*real, value);
    else
      return fail(fmt::format("{} is not {}", as_written(value), type_text(parameter_, {})));
    if (result && !parameter_.range.contains(*result))
      return fail(fmt::format("{} is out of range{}", as_written(value), hint(*result)));

    return result;
  }

  /// ": what a value was probably meant for", or nothing.
  std::string hint(double value) const {
    const std::string text = parameter_.range.hint ? parameter_.range.hint(value) : std::string();
    return text.empty() ? text : ": " + text;
  }

  std::optional<double> plain(double value, const CaseValue& written) {
    if (!std::isfinite(value)) return fail(fmt::format("{} is not a finite number", as_written(written)));
    if (parameter_.dimension != dimension::none) return fail(fmt::format("{} has no unit", as_written(written)));
    return value;
  }

  std::optional<double> quantity(const std::string& text) {
    const std::string written = as_written({text});
    std::string why;
    const std::optional<Quantity> read = parse_quantity(text, &why);
    if (!read) return fail(fmt::format("{} {}", written, why));
    if (parameter_.dimension == dimension::none) {
      if (read->dimension == dimension::none) return wrong_type({text});
      constexpr double degrees = 57.29577951308232;
      const bool is_angle = read->dimension == dimension::angle;
      return fail(fmt::format("{} has a unit where a plain number is due{}", written,
                              hint(is_angle ? degrees * read->value : 0)));
    }
    if (read->dimension == dimension::none) return fail(fmt::format("{} has no unit", written));
    if (read->dimension != parameter_.dimension)
      return fail(fmt::format("{} is not {} but {}", written, type_text(parameter_, {}),
                              type_text({.key = {}, .dimension = read->dimension, .text = {}}, {})));
    return read->value;
  }

  std::optional<std::int64_t> integer(const CaseValue& value) {
    constexpr double exact = 9007199254740992;  // 2^53: up to here a double is the whole number that was written
    std::optional<std::int64_t> whole;
    if (const auto* written = std::get_if<std::int64_t>(&value.value)) whole = *written;
    if (const auto* real = std::get_if<double>(&value.value))  // 1e6
      if (std::abs(*real) <= exact && *real == std::floor(*real)) whole = static_cast<std::int64_t>(*real);
    if (!whole) return wrong_type(value);
    if (!parameter_.range.contains(static_cast<double>(*whole)))
      return fail(fmt::format("{} is out of range", as_written(value)));
    return whole;
  }

  std::optional<std::string> choice(const CaseValue& value) {
    const auto* text = std::get_if<std::string>(&value.value);
    if (text && std::find(type_.choices.begin(), type_.choices.end(), *text) != type_.choices.end()) return *text;
    return fail(fmt::format("{} is not {}", as_written(value), type_text(parameter_, type_)),
                text ? std::string(nearest(*text, type_.choices)) : std::string());
  }

  std::optional<std::vector<double>> numbers(const CaseValue& value) {
    const auto* values = std::get_if<std::vector<CaseValue>>(&value.value);
    if (!values) return fail(fmt::format("{} is not {}", as_written(value), type_text(parameter_, type_)));
    if (type_.shape == ValueType::Shape::three && values->size() != 3)
      return fail(fmt::format("has {} value{} and not 3", values->size(), values->size() == 1 ? "" : "s"));
    std::vector<double> result;
    for (const CaseValue& element : *values) {
      const auto one = number(element);
      if (!one) return fail(fmt::format("value {}: {}", result.size() + 1, fault_.what));
      result.push_back(*one);
    }
    return result;
  }

  const Parameter& parameter_;
  const ValueType& type_;
  ValueFault& fault_;
};

}  // namespace

std::optional<ParameterValue> convert_value(const CaseEntry& entry, const Parameter& parameter, const ValueType& type,
                                            ValueFault& fault) {
  return Converter(parameter, type, fault).convert(entry);
}

std::string as_written(const CaseValue& value) {
  struct Describe {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(const std::string& text) const {
      std::size_t length = 60;
      if (text.size() <= length) return quoted(text);
      while ((static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;  // not within a letter of UTF-8
      return quoted(text.substr(0, length) + "...");
    }
    std::string operator()(const std::vector<CaseValue>& values) const {
      const bool tables = !values.empty() && std::holds_alternative<CaseTable>(values.front().value);
      return tables ? "an array of tables" : "an array";
    }
    std::string operator()(const CaseTable&) const { return "a table"; }
    std::string operator()(const CaseDate& date) const { return fmt::format("the date {}", date.text); }
  };
  return std::visit(Describe{}, value.value);
}

}  // namespace talus
