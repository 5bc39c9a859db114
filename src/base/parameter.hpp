// SPDX-License-Identifier: Apache-2.0
/// The description of a parameter. A model lists its parameters once, in a function template
///
///     template <class Visit> void for_each_parameter(Visit&& visit, Parameters& p) {
///       visit(Parameter{"particles.radius", dimension::length, above(0), "mean radius"}, p.radius);
///       ...
///     }
///
/// from which parsing, defaults, ranges, the JSON schema, the reference page and `check` follow. The type of the member
/// says what is read: double (a quantity with a unit, or a plain number if the dimension is none), std::int64_t, bool,
/// std::string, std::array<double, 3>, std::vector<double> (any number of values), an enumeration with `choices`, or
/// std::optional of one of these (may be left out). The member's initial value is the default, except where `required`
/// is set.
///
/// A choice owns its keys: keys that are meaningful for one choice only are visited under a condition, the keys of one
/// alternative in a table of its own,
///
///     auto timed = only_if(where("gate.opens", p.gate.opens, GateOpens::at_time), visit);
///     timed(Parameter{"gate.time", ...}, p.gate.time);
///
///     auto own = in_table("law.drucker-prager", visit);
///     own(Parameter{"friction", ...}, law.friction);
///
/// and a case that gives such a key where the condition fails is an error.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/unit.hpp"

namespace talus {

/// Allowed values, bounds in SI.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
  bool max_excluded = false;
  std::string (*hint)(double value) = nullptr;  ///< the probable intention of a value beyond the bounds; may be empty

  constexpr bool contains(double value) const {
    return (min_excluded ? value > min : value >= min) && (max_excluded ? value < max : value <= max);
  }
};

constexpr Range any() {
  return {};
}
constexpr Range above(double min) {
  return {.min = min, .min_excluded = true};
}
constexpr Range at_least(double min) {
  return {.min = min};
}
constexpr Range between(double min, double max) {
  return {.min = min, .max = max};
}

/// A coefficient of friction, the tangent of an angle: one beyond 2 (63 degrees) was probably meant for the angle.
inline Range friction_coefficient() {
  return {.min = 0, .max = 2, .hint = [](double value) -> std::string {
            if (!(value > 2 && value < 90)) return {};
            return fmt::format("{:g} looks like an angle in degrees, whose tangent is {:.2f}", value,
                               std::tan(value * std::numbers::pi / 180));
          }};
}

/// The condition under which a key is meaningful.
struct Condition {
  std::string key = {};     ///< of the choice: "gate.opens"; empty: no condition
  std::string found = {};   ///< in the case: `is "when-settled"`
  std::string needed = {};  ///< required: `= "at-time"`
  bool holds = true;
};

struct Parameter {
  std::string key;  ///< dotted: "particles.radius"
  Dimension dimension = dimension::none;
  Range range = {};
  std::string_view text = {};  ///< one sentence for the reference page
  bool required = false;
  Condition condition = {};
};

/// A former key: if a case has it, the error gives the new one.
struct RenamedKey {
  std::string_view old;
  std::string_view now;  ///< a key, or in words what to write
};

/// Names of an enumeration's values, in the order of the values from 0. Specialise next to the enumeration:
///     template <> inline constexpr auto choices<Plane> = std::to_array<std::string_view>({"xy", "xz", "xyz"});
template <class Enumeration>
inline constexpr std::array<std::string_view, 0> choices{};

/// The name of an enumeration's value.
template <class Enumeration>
constexpr std::string_view choice_name(Enumeration value) {
  return choices<Enumeration>[static_cast<std::size_t>(value)];
}

/// The value of a choice as it is written in a case file.
template <class T>
std::string value_text(const T& value) {
  if constexpr (std::is_same_v<T, bool>)
    return value ? "true" : "false";
  else
    return "\"" + std::string(choice_name(value)) + "\"";
}

/// The condition that a choice has a given value.
template <class T>
Condition where(std::string key, const T& value, const std::type_identity_t<T>& wanted) {
  return {std::move(key), "is " + value_text(value), "= " + value_text(wanted), value == wanted};
}

/// The condition that a choice does not have a given value.
template <class T>
Condition unless(std::string key, const T& value, const std::type_identity_t<T>& unwanted) {
  return {std::move(key), "is " + value_text(value), "other than " + value_text(unwanted), value != unwanted};
}

/// Visits keys that are meaningful only if a condition holds. Of nested ones, the outermost that fails is reported.
template <class Visit>
auto only_if(Condition condition, Visit& visit) {
  return [condition = std::move(condition), &visit](Parameter parameter, auto& member) {
    if (!condition.holds) parameter.condition = condition;
    visit(parameter, member);
  };
}

/// Visits keys of a table, whose conditions are on keys of the same table.
template <class Visit>
auto in_table(std::string table, Visit& visit) {
  return [table = std::move(table), &visit](Parameter parameter, auto& member) {
    parameter.key = table + "." + parameter.key;
    if (!parameter.condition.key.empty()) parameter.condition.key = table + "." + parameter.condition.key;
    visit(parameter, member);
  };
}

}  // namespace talus
