// SPDX-License-Identifier: Apache-2.0
/// Decimal numbers of arbitrary length, so that "200 um" becomes the double nearest to 0.0002 and not 200 times a
/// rounded 1e-6: units scale the digits as written, and the result is rounded once.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace talus {

/// Of the ten of ASCII, whatever the locale.
constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// (-1)^negative * digits * 10^exponent.
struct Decimal {
  std::string digits = "0";  ///< '0' to '9' only, at least one
  int exponent = 0;
  bool negative = false;
};

/// Takes the longest decimal number from the front of `text` ("-1.82e-5", "+2.", ".5"); nothing, and `text` unchanged,
/// if it does not begin with one.
std::optional<Decimal> take_decimal(std::string_view& text);

/// The number itself, to 40 digits (exact for nearly all practical input).
Decimal to_decimal(double value);

/// The shortest decimal that rounds to this double.
Decimal shortest_decimal(double value);

/// The nearest double; nothing if it is too large or vanishes.
std::optional<double> to_double(const Decimal& decimal);

Decimal operator*(const Decimal& a, const Decimal& b);

/// Rounded to so many digits, half away from zero.
Decimal rounded(Decimal decimal, std::size_t count);

/// "0.0002", "-45", "1.5e-07": positional between 1e-4 and 1e16, as for numbers elsewhere.
std::string to_string(Decimal decimal);

}  // namespace talus
