// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "base/decimal.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/case_file.hpp"

namespace talus {

namespace {

std::string with_article(std::string_view noun) {
  return fmt::format("{} {}", std::string_view("aeiou").find(noun.front()) == std::string_view::npos ? "a" : "an",
                     noun);
}

std::string one_type_text(const Parameter& parameter, ValueType::Kind kind) {
  switch (kind) {
    case ValueType::Kind::number:
      return with_article(dimension_name(parameter.dimension));
    case ValueType::Kind::integer:
      return "a whole number";
    case ValueType::Kind::flag:
      return "true or false";
    case ValueType::Kind::text:
      return "text in quotes";
    case ValueType::Kind::choice:
      return "one of the choices";
  }
  return {};
}

/// In SI: the usual example if the range allows it, else a number within.
double example_value(const Parameter& parameter) {
  const Range& range = parameter.range;
  const double usual = parse_quantity(unit_example(parameter.dimension))->value;
  if (range.contains(usual)) return usual;
  const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
  if (has_min && !range.min_excluded) return range.min;
  if (has_max && !range.max_excluded) return range.max;
  if (has_min && has_max) return range.min + (range.max - range.min) / 2;
  return has_min ? range.min + std::abs(range.min) + 1 : range.max - std::abs(range.max) - 1;
}

std::string number_literal(double value, std::string_view unit) {
  return unit.empty() ? number_text(value) : fmt::format("\"{}\"", format_quantity(value, unit));
}

}  // namespace

ParameterList ParameterList::that_hold() const {
  ParameterList list = *this;
  std::erase_if(list.items_, [](const DescribedParameter& item) { return !item.parameter.condition.holds; });
  return list;
}

std::vector<std::string_view> ParameterList::tables() const {
  std::vector<std::string_view> tables;
  for (const DescribedParameter& item : items_) {
    const std::string_view table = table_of(item.parameter.key);
    if (std::find(tables.begin(), tables.end(), table) == tables.end())
      tables.insert(table.empty() ? tables.begin() : tables.end(), table);
  }
  return tables;
}

std::string range_text(const Parameter& parameter) {
  const Range& range = parameter.range;
  const std::string unit = example_unit(parameter.dimension);
  const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
  const std::string low = has_min ? format_quantity(range.min, unit) : "";
  const std::string high = has_max ? format_quantity(range.max, unit) : "";
  if (has_min && has_max && !range.min_excluded && !range.max_excluded) return fmt::format("from {} to {}", low, high);
  std::string text;
  if (has_min) text = fmt::format("{} {}", range.min_excluded ? "above" : "at least", low);
  if (has_min && has_max) text += " and ";
  if (has_max) text += fmt::format("{} {}", range.max_excluded ? "below" : "at most", high);
  return text;
}

std::string type_text(const Parameter& parameter, const ValueType& type) {
  if (type.shape == ValueType::Shape::three) return "an array of 3 values";
  if (type.shape == ValueType::Shape::any) return "an array";
  return one_type_text(parameter, type.kind);
}

std::string allowed_text(const Parameter& parameter, const ValueType& type) {
  if (type.kind == ValueType::Kind::choice) return fmt::format("{}", fmt::join(type.choices, ", "));
  std::string text = one_type_text(parameter, type.kind);
  if (type.shape == ValueType::Shape::three) text = fmt::format("3 values in brackets, each {}", text);
  if (type.shape == ValueType::Shape::any) text = fmt::format("values in brackets, each {}", text);
  if (const std::string range = range_text(parameter); !range.empty()) text += fmt::format(", {}", range);
  if (type.kind == ValueType::Kind::number) text += fmt::format(", such as {}", example_text(parameter, type));
  return text;
}

std::string example_text(const Parameter& parameter, const ValueType& type) {
  switch (type.kind) {
    case ValueType::Kind::number: {
      const std::string one = number_literal(example_value(parameter), example_unit(parameter.dimension));
      if (type.shape == ValueType::Shape::three) return fmt::format("[{}, {}, {}]", one, one, one);
      return type.shape == ValueType::Shape::any ? fmt::format("[{}]", one) : one;
    }
    case ValueType::Kind::integer:
      return to_string(shortest_decimal(std::isfinite(parameter.range.min) ? std::ceil(parameter.range.min) : 1));
    case ValueType::Kind::flag:
      return "true";
    case ValueType::Kind::text:
      return "\"text\"";
    case ValueType::Kind::choice:
      return talus::quoted(type.choices.front());  // not std::quoted
  }
  return {};
}

ParameterValue trial_value(const Parameter& parameter, const ValueType& type, int trial) {
  const Range& range = parameter.range;
  // Not the same for two keys: equal lengths would contradict each other in a way of their own.
  const double of_key = 1 + static_cast<double>(std::hash<std::string>()(parameter.key) % 97) / 1000;
  const auto number = [&](int position) {
    constexpr std::array<double, 4> sizes{0.3, 20, 0.007, 400}, shares{0.3, 0.8, 0.1, 0.55};
    const auto n = static_cast<std::size_t>(trial) % sizes.size();
    const double size = (1 + position) * of_key * sizes[n];
    const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
    if (has_min && has_max) return range.min + shares[n] / (of_key * (1 + 0.1 * position)) * (range.max - range.min);
    return has_min ? range.min + size : has_max ? range.max - size : size;
  };
  if (type.shape != ValueType::Shape::one) {
    std::vector<double> values;
    for (int position = 0; position < (type.shape == ValueType::Shape::three ? 3 : 2 + trial % 2); ++position)
      values.push_back(number(position));
    return values;
  }
  switch (type.kind) {
    case ValueType::Kind::number:
      return number(0);
    case ValueType::Kind::integer:
      return static_cast<std::int64_t>(std::clamp(std::round(number(0)), std::ceil(range.min), range.max));
    case ValueType::Kind::flag:
      return trial % 2 == 0;
    case ValueType::Kind::text:
      return fmt::format("text {}", trial);
    case ValueType::Kind::choice:
      return std::string(type.choices[static_cast<std::size_t>(trial) % type.choices.size()]);
  }
  return {};
}

std::string toml_text(const Parameter& parameter, const ParameterValue& value) {
  const std::string unit = unit_name(parameter.dimension);
  struct Write {
    const std::string& unit;
    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return number_literal(number, unit); }
    std::string operator()(const std::string& text) const { return talus::quoted(text); }
    std::string operator()(const std::vector<double>& numbers) const {
      std::vector<std::string> texts;
      for (const double number : numbers) texts.push_back(number_literal(number, unit));
      return fmt::format("[{}]", fmt::join(texts, ", "));
    }
  };
  return std::visit(Write{unit}, value);
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result.append(1, '\\').append(1, c);
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      result += c;
  }
  return result + '"';
}

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

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
      if (text.size() <= length) return talus::quoted(text);
      while ((static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;  // not within a letter of UTF-8
      return talus::quoted(text.substr(0, length) + "...");
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
