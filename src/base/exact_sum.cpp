// SPDX-License-Identifier: Apache-2.0
#include "base/exact_sum.hpp"

#include <bit>
#include <cmath>

namespace talus {

namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::uint64_t mantissa_bits = 52, mantissa_mask = (std::uint64_t{1} << mantissa_bits) - 1;
constexpr std::uint64_t exponent_mask = 0x7ff;

}  // namespace

void ExactSum::add(double term) {
  const auto bits = std::bit_cast<std::uint64_t>(term);
  const std::uint64_t exponent = bits >> mantissa_bits & exponent_mask;
  if (exponent == exponent_mask) {
    not_finite_ += term;
    return;
  }
  // The number is mantissa * 2^(shift - 1074).
  std::uint64_t mantissa = bits & mantissa_mask, shift = 0;
  if (exponent > 0) mantissa |= mantissa_mask + 1, shift = exponent - 1;
  const std::size_t digit = shift / digit_bits;
  const Wide shifted = static_cast<Wide>(mantissa) << shift % digit_bits;
  constexpr std::uint64_t low = 0xffffffff;
  const auto first = static_cast<std::int64_t>(static_cast<std::uint64_t>(shifted) & low),
             second = static_cast<std::int64_t>(static_cast<std::uint64_t>(shifted >> 32) & low),
             third = static_cast<std::int64_t>(static_cast<std::uint64_t>(shifted >> 64));
  const std::int64_t sign = bits >> 63 ? -1 : 1;
  digits_[digit] += sign * first, digits_[digit + 1] += sign * second, digits_[digit + 2] += sign * third;
  if (++since_carry_ >> 30) carry(digits_), since_carry_ = 1;
}

void ExactSum::add(const ExactSum& other) {
  Digits theirs = other.digits_;
  carry(theirs);
  for (std::size_t n = 0; n < digit_count; ++n) digits_[n] += theirs[n];
  not_finite_ += other.not_finite_;
  if (++since_carry_ >> 30) carry(digits_), since_carry_ = 1;
}

/// Leaves digits from 0 to the base, but for the highest, which has the sign.
void ExactSum::carry(Digits& digits) {
  for (std::size_t n = 0; n + 1 < digit_count; ++n) {
    const std::int64_t over = digits[n] >> digit_bits;  // rounded down
    digits[n] -= over << digit_bits;
    digits[n + 1] += over;
  }
}

double ExactSum::value() const {
  if (not_finite_ != 0) return not_finite_;
  Digits digits = digits_;
  carry(digits);
  const bool is_negative = digits.back() < 0;
  if (is_negative) {
    for (std::int64_t& digit : digits) digit = -digit;
    carry(digits);
  }
  std::size_t top = digit_count - 1;
  while (top > 0 && digits[top] == 0) --top;
  // The 64 highest bits of three digits, the lowest of them set if any below is: a conversion to double rounds once.
  const auto digit = [&](std::size_t below_top) {
    return static_cast<std::uint64_t>(top >= below_top ? digits[top - below_top] : 0);
  };
  if (digit(0) == 0) return 0;
  if (top < 2)  // an integer below 2^64 times the least double
    return std::ldexp(static_cast<double>(is_negative ? -1 : 1) *
                          static_cast<double>(digit(0) << digit_bits * top | (top > 0 ? digit(1) : 0)),
                      -1074);
  const int spare = std::countl_zero(digit(0)) - digit_bits;
  const Wide three = static_cast<Wide>(digit(0)) << 64 | digit(1) << 32 | digit(2);
  auto leading = static_cast<std::uint64_t>(three >> (digit_bits - spare));
  bool is_more = static_cast<std::uint64_t>(three) << (digit_bits + spare) != 0;
  for (std::size_t n = 3; n <= top && !is_more; ++n) is_more = digits[top - n] != 0;
  leading |= is_more ? 1 : 0;
  const double size =
      std::ldexp(static_cast<double>(leading), static_cast<int>(digit_bits * top) - digit_bits - spare - 1074);
  return is_negative ? -size : size;
}

double exact_sum(std::span<const double> terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

FixedPoint::FixedPoint(double unit) {
  int exponent = 0;
  std::frexp(unit, &exponent);
  per_coarse_ = std::ldexp(1.0, coarse_bits - exponent);
  quantum_ = std::ldexp(1.0, exponent - coarse_bits - fine_bits);
}

}  // namespace talus
