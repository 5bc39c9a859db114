// SPDX-License-Identifier: Apache-2.0
/// The types that a parameter may have, defined once: reader, writer, schema and reference page treat a parameter as a
/// `ValueType` and a `ParameterValue`, and only this file depends on their members.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/parameter.hpp"
#include "io/case_file.hpp"

namespace talus {

struct ValueType {
  enum class Kind { number, integer, flag, text, choice };
  enum class Shape { one, three, any };  ///< a value, an array of three numbers, an array of any length
  Kind kind = Kind::number;
  Shape shape = Shape::one;
  bool optional = false;                        ///< may be left out and then has no value
  std::span<const std::string_view> choices{};  ///< of a choice
};

/// Nothing (an optional left out), flag, integer, number (SI), text or choice, array of numbers (SI).
using ParameterValue = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>>;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
constexpr ValueType value_type() {
  using Kind = ValueType::Kind;
  if constexpr (is_optional<T>) {
    ValueType type = value_type<typename T::value_type>();
    type.optional = true;
    return type;
  } else if constexpr (std::is_enum_v<T>) {
    static_assert(choices<T>.size() > 0, "specialise talus::choices next to the enumeration");
    return {.kind = Kind::choice, .choices = choices<T>};
  } else if constexpr (std::is_same_v<T, bool>) {
    return {.kind = Kind::flag};
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return {.kind = Kind::integer};
  } else if constexpr (std::is_same_v<T, std::string>) {
    return {.kind = Kind::text};
  } else if constexpr (std::is_same_v<T, std::array<double, 3>>) {
    return {.shape = ValueType::Shape::three};
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    return {.shape = ValueType::Shape::any};
  } else {
    static_assert(std::is_same_v<T, double>, "a parameter of this type cannot be read");
    return {};
  }
}

template <class T>
ParameterValue to_value(const T& member) {
  if constexpr (is_optional<T>)
    return member ? to_value(*member) : ParameterValue{};
  else if constexpr (std::is_enum_v<T>)
    return std::string(choice_name(member));
  else if constexpr (std::is_same_v<T, std::array<double, 3>>)
    return std::vector<double>(member.begin(), member.end());
  else
    return member;
}

/// \param value of the type value_type<T>(), a choice among its choices
template <class T>
void from_value(const ParameterValue& value, T& member) {
  if constexpr (is_optional<T>) {
    from_value(value, member.emplace());
  } else if constexpr (std::is_enum_v<T>) {
    for (std::size_t i = 0; i < choices<T>.size(); ++i)
      if (choices<T>[i] == std::get<std::string>(value)) member = static_cast<T>(i);
  } else if constexpr (std::is_same_v<T, std::array<double, 3>>) {
    for (std::size_t i = 0; i < 3; ++i) member[i] = std::get<std::vector<double>>(value)[i];
  } else {
    member = std::get<T>(value);
  }
}

/// A parameter with the value it has.
struct DescribedParameter {
  Parameter parameter;
  ValueType type;
  ParameterValue value;
};

/// Collects parameters in the order of their lists:
///     ParameterList list;
///     for_each_parameter(list, model_parameters);
///     for_each_parameter(list, run_parameters);
/// Texts are not copied; they are literals.
class ParameterList {
 public:
  template <class T>
  void operator()(const Parameter& parameter, const T& member) {
    items_.push_back({parameter, value_type<T>(), to_value(member)});
  }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }

  /// Those whose conditions hold: what a case consists of.
  ParameterList that_hold() const;

  /// Names of the tables in the order of their first keys; "" for the keys at the top is the first, if there are such.
  std::vector<std::string_view> tables() const;

 private:
  std::vector<DescribedParameter> items_;
};

/// "above 0 mm", "from 0 deg to 90 deg"; "" if every value is allowed. In the unit of the dimension's usual example.
std::string range_text(const Parameter& parameter);

/// "a length", "a whole number", "true or false", "text in quotes", "one of the choices", "an array of 3 values".
std::string type_text(const Parameter& parameter, const ValueType& type);

/// All that is allowed, with an example: "a length, above 0 mm, such as \"5 mm\""; "circle, rectangle, triangle".
std::string allowed_text(const Parameter& parameter, const ValueType& type);

/// A valid value, as TOML: "\"5 mm\"".
std::string example_text(const Parameter& parameter, const ValueType& type);

/// A value within the parameter's range, another for every number of a trial and, of numbers, for every key: from some
/// millimetres to some hundred metres where the range is without bounds.
ParameterValue trial_value(const Parameter& parameter, const ValueType& type, int trial);

/// A value as TOML in SI; it reads back bitwise identical. Quantities are quoted, with their unit.
std::string toml_text(const Parameter& parameter, const ParameterValue& value);

/// Text as a TOML (and JSON) string with its quotes.
std::string quoted(std::string_view text);

/// The shortest text of a number that TOML reads back to the same double, and not to an integer: "20.0", "1e-07".
std::string number_text(double value);

// One value of a case file as a parameter needs it: right type, right dimension, within its range, finite; or why not.

/// Why a value cannot be taken.
struct ValueFault {
  std::string what;          ///< "\"5 kg\" is not a length but a mass"
  std::string nearest = {};  ///< the choice that was probably meant
};

/// \returns nothing if the value cannot be taken; `fault` then says why
std::optional<ParameterValue> convert_value(const CaseEntry& entry, const Parameter& parameter, const ValueType& type,
                                            ValueFault& fault);

/// The choice that a key of the case names, if it is one.
template <class Choice>
std::optional<Choice> choice_in(const CaseFile& file, std::string_view key) {
  const CaseEntry* entry = file.find(key);
  const auto* name = entry ? std::get_if<std::string>(&entry->value.value) : nullptr;
  for (std::size_t n = 0; name && n < choices<Choice>.size(); ++n)
    if (choices<Choice>[n] == *name) return static_cast<Choice>(n);
  return std::nullopt;
}

/// A value as it was written, for messages: `"5 mm"`, `2.5`, `an array`; long text is cut.
std::string as_written(const CaseValue& value);

}  // namespace talus
