// SPDX-License-Identifier: Apache-2.0
/// Sums of doubles that do not depend on the order of their terms, so that threads and processes may share them in any
/// way. ExactSum takes any doubles and is correctly rounded (a small superaccumulator: R. M. Neal 2015, Fast exact
/// summation using small and large superaccumulators, arXiv:1505.05571). FixedPoint is for the terms of hot loops whose
/// unit is known: its sums are integers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"

namespace talus {

class ExactSum {
 public:
  void add(double term);
  void add(const ExactSum& other);
  /// The sum, rounded to nearest, ties to even; infinite or no number as the sum of the terms is in any order.
  double value() const;

 private:
  static constexpr int digit_bits = 32;
  // From 2^-1074, the least double, over the largest one to sums of 2^63 of them.
  static constexpr std::size_t digit_count = 68;
  using Digits = std::array<std::int64_t, digit_count>;

  static void carry(Digits& digits);

  Digits digits_{};                // of base 2^digit_bits, with room for carries
  std::uint32_t since_carry_ = 0;  // terms added since each digit was below the base
  double not_finite_ = 0;          // sum of the terms that are infinite or no numbers
};

/// Sum of the terms, correctly rounded.
double exact_sum(std::span<const double> terms);

/// Sum of value(i) over i in [0, count), correctly rounded.
template <class Value>
double exact_sum(ThreadTeam& team, std::size_t count, Value&& value) {
  constexpr std::size_t parts = 64;
  std::array<ExactSum, parts> partial;
  const std::size_t length = (count + parts - 1) / parts;
  team.run(length > 0 ? parts : 0, [&](std::size_t part) {
    for (std::size_t i = part * length; i < count && i < (part + 1) * length; ++i) partial[part].add(value(i));
  });
  ExactSum total;
  for (const ExactSum& part : partial) total.add(part);
  return total.value();
}

/// Integers in place of doubles: multiples of 2^-84 of a unit. A term may be as large as 2^40 units, and a sum 2^42.
class FixedPoint {
 public:
  /// Two's complement: sums wrap around in place of overflowing.
  __extension__ using Integer = unsigned __int128;

  /// \param unit about the size of a large term, > 0; rounded up to a power of two
  explicit FixedPoint(double unit);

  /// The nearest multiple; terms smaller than 2^-31 units lose digits that a double has. A term that is too large, or
  /// no number, counts as the largest: the sum is then visibly absurd.
  Integer of(double term) const {
    const double units = term * per_coarse_;
    if (!(__builtin_fabs(units) < max_coarse))
      return static_cast<Integer>(std::int64_t{1} << (coarse_bits + 40)) << fine_bits;
    const double coarse = __builtin_rint(units);
    return (static_cast<Integer>(static_cast<std::int64_t>(coarse)) << fine_bits) +
           static_cast<Integer>(static_cast<std::int64_t>(__builtin_rint((units - coarse) * fine_per_coarse)));
  }
  double value(Integer sum) const { return static_cast<double>(static_cast<Signed>(sum)) * quantum_; }

 private:
  __extension__ using Signed = __int128;
  static constexpr int coarse_bits = 22, fine_bits = 62;
  static constexpr double fine_per_coarse = 0x1p62, max_coarse = 0x1p62;

  double per_coarse_;  // 2^coarse_bits over the unit
  double quantum_;
};

/// Sums in fixed point as files hold them: the lower and the higher half of each, one after another.
class FixedSums {
 public:
  explicit FixedSums(std::size_t count = 0) : halves_(2 * count) {}

  void add(std::size_t n, FixedPoint::Integer term) {
    const FixedPoint::Integer sum = (*this)[n] + term;
    halves_[2 * n] = static_cast<std::int64_t>(sum), halves_[2 * n + 1] = static_cast<std::int64_t>(sum >> 64);
  }
  FixedPoint::Integer operator[](std::size_t n) const {
    return (static_cast<FixedPoint::Integer>(halves_[2 * n + 1]) << 64) + static_cast<std::uint64_t>(halves_[2 * n]);
  }
  void clear() { std::fill(halves_.begin(), halves_.end(), 0); }

  auto& halves() { return halves_; }
  const auto& halves() const { return halves_; }

 private:
  std::vector<std::int64_t> halves_;
};

/// Three sums in fixed point.
struct FixedVector {
  std::array<FixedPoint::Integer, 3> component{};

  void add(const FixedPoint& point, const Vector3& term) {
    // The walls of a box push along one axis only.
    for (int axis = 0; axis < 3; ++axis)
      if (term[axis] != 0) component[static_cast<std::size_t>(axis)] += point.of(term[axis]);
  }
  FixedVector& operator+=(const FixedVector& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) component[axis] += other.component[axis];
    return *this;
  }
  Vector3 value(const FixedPoint& point) const {
    return {point.value(component[0]), point.value(component[1]), point.value(component[2])};
  }
};

}  // namespace talus
