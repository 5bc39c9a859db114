// SPDX-License-Identifier: Apache-2.0
/// How a parameter is described, once. A model lists its parameters in a function template
///
///     template <class Visit> void for_each_parameter(Visit&& visit, Parameters& p) {
///       visit(Parameter{"particles.radius", dimension::length, above(0), "mean radius"}, p.radius);
///       ...
///     }
///
/// and parsing, defaults, ranges, the JSON schema, the reference page and `check` follow from that one list.
/// The type of the member says what is read: double (a quantity with a unit, or a plain number if the dimension is
/// none), std::int64_t, bool, std::string, std::array<double, 3>, std::vector<double> (any number of values), an
/// enumeration with `choices`, or std::optional of one of these (may be left out). The member's initial value is the
/// default, except where `required` is set.
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "base/unit.hpp"

namespace talus {

/// Allowed values, bounds in SI.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_excluded = false;
  bool most_excluded = false;

  constexpr bool contains(double value) const {
    return (least_excluded ? value > least : value >= least) && (most_excluded ? value < most : value <= most);
  }
};

constexpr Range any() {
  return {};
}
constexpr Range above(double least) {
  return {.least = least, .least_excluded = true};
}
constexpr Range at_least(double least) {
  return {.least = least};
}
constexpr Range between(double least, double most) {
  return {.least = least, .most = most};
}

struct Parameter {
  std::string_view key;  ///< dotted: "particles.radius"
  Dimension dimension = dimension::none;
  Range range = {};
  std::string_view text;  ///< one sentence for the reference page
  bool required = false;
};

/// Names of an enumeration's values, in the order of the values from 0. Specialise beside the enumeration:
///     template <> inline constexpr auto choices<Plane> = std::to_array<std::string_view>({"xy", "xz", "xyz"});
template <class Enumeration>
inline constexpr std::array<std::string_view, 0> choices{};

/// The name of an enumeration's value.
template <class Enumeration>
constexpr std::string_view choice_name(Enumeration value) {
  return choices<Enumeration>[static_cast<std::size_t>(value)];
}

}  // namespace talus
