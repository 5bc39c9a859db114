// SPDX-License-Identifier: Apache-2.0
#include "base/decimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace talus {

namespace {

constexpr int exponent_limit = 100000;  // far outside the range of a double, far inside the range of an int

std::string_view take_digits(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  const std::string_view digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  return digits;
}

/// 'e', a sign or none, digits; 0 and `text` unchanged if that is not what follows ("5 exa").
int take_exponent(std::string_view& text) {
  std::string_view rest = text;
  if (rest.empty() || (rest.front() != 'e' && rest.front() != 'E')) return 0;
  rest.remove_prefix(1);
  const bool negative = rest.starts_with('-');
  if (rest.starts_with('-') || rest.starts_with('+')) rest.remove_prefix(1);
  const std::string_view digits = take_digits(rest);
  if (digits.empty()) return 0;
  int exponent = 0;
  for (const char c : digits) exponent = std::min(exponent_limit, 10 * exponent + (c - '0'));
  text = rest;
  return negative ? -exponent : exponent;
}

Decimal from_scientific(std::string_view text) {
  return *take_decimal(text);
}

}  // namespace

std::optional<Decimal> take_decimal(std::string_view& text) {
  std::string_view rest = text;
  Decimal decimal;
  decimal.negative = rest.starts_with('-');
  if (rest.starts_with('-') || rest.starts_with('+')) rest.remove_prefix(1);
  decimal.digits = take_digits(rest);
  if (rest.starts_with('.')) {
    rest.remove_prefix(1);
    const std::string_view fraction = take_digits(rest);
    decimal.digits += fraction;
    decimal.exponent = -static_cast<int>(std::min<std::size_t>(fraction.size(), exponent_limit));
  }
  if (decimal.digits.empty()) return std::nullopt;
  decimal.exponent += take_exponent(rest);
  text = rest;
  return decimal;
}

Decimal to_decimal(double value) {
  return from_scientific(fmt::format("{:.39e}", value));
}

Decimal shortest_decimal(double value) {
  return from_scientific(fmt::format("{}", value));
}

std::optional<double> to_double(const Decimal& decimal) {
  const std::string text = fmt::format("{}{}e{}", decimal.negative ? "-" : "", decimal.digits, decimal.exponent);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Decimal operator*(const Decimal& a, const Decimal& b) {
  std::string product(a.digits.size() + b.digits.size(), '\0');  // digits as numbers, most significant first
  for (std::size_t i = a.digits.size(); i-- > 0;) {
    int carry = 0;
    for (std::size_t j = b.digits.size(); j-- > 0;) {
      const int sum = product[i + j + 1] + (a.digits[i] - '0') * (b.digits[j] - '0') + carry;
      product[i + j + 1] = static_cast<char>(sum % 10);
      carry = sum / 10;
    }
    product[i] = static_cast<char>(carry);
  }
  for (char& c : product) c = static_cast<char>(c + '0');
  return {std::move(product), a.exponent + b.exponent, a.negative != b.negative};
}

Decimal rounded(Decimal decimal, std::size_t count) {
  std::string& digits = decimal.digits;
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  if (digits.size() <= count) return decimal;
  const bool up = digits[count] >= '5';
  decimal.exponent += static_cast<int>(digits.size() - count);
  digits.resize(count);
  if (up) {
    std::size_t i = count;
    while (i > 0 && digits[i - 1] == '9') digits[--i] = '0';
    if (i > 0)
      ++digits[i - 1];
    else
      digits.insert(digits.begin(), '1');
  }
  return decimal;
}

std::string to_string(Decimal decimal) {
  std::string& digits = decimal.digits;
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  for (; digits.size() > 1 && digits.back() == '0'; ++decimal.exponent) digits.pop_back();
  if (digits == "0") decimal.exponent = 0;
  const int size = static_cast<int>(digits.size());
  const int point = size + decimal.exponent;  // the decimal point stands after so many digits
  const std::string_view sign = decimal.negative ? "-" : "";
  if (point > 16 || point < -3) {
    if (size > 1) digits.insert(1, 1, '.');
    return fmt::format("{}{}e{:+03d}", sign, digits, point - 1);
  }
  if (point > size) digits.append(static_cast<std::size_t>(point - size), '0');
  if (point <= 0) digits.insert(0, static_cast<std::size_t>(1 - point), '0');
  if (point < size) digits.insert(static_cast<std::size_t>(std::max(point, 1)), 1, '.');
  return fmt::format("{}{}", sign, digits);
}

}  // namespace talus
