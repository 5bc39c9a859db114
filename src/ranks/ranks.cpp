// SPDX-License-Identifier: Apache-2.0
#include "ranks/ranks.hpp"

namespace talus {

namespace {

// A sum of 128 bits is told in digits: sums of up to 2^32 processes do not overflow, and carries follow at the end.
constexpr int digit_bits = 32;
constexpr std::size_t digits = 4;

void add_digits(FixedPoint::Integer sum, std::vector<std::uint64_t>& told) {
  for (std::size_t d = 0; d < digits; ++d)
    told.push_back(static_cast<std::uint32_t>(sum >> (digit_bits * static_cast<int>(d))));
}

FixedPoint::Integer sum_of_digits(const std::uint64_t* told) {
  FixedPoint::Integer sum = 0;
  for (std::size_t d = 0; d < digits; ++d)
    sum += static_cast<FixedPoint::Integer>(told[d]) << (digit_bits * static_cast<int>(d));
  return sum;
}

}  // namespace

bool all_of(const Ranks& ranks, bool vote) {
  if (ranks.is_alone()) return vote;
  Votes votes{.least = {vote ? 1.0 : 0.0}, .largest = {}, .sum = {}};
  ranks.join(votes);
  return votes.least[0] > 0;
}

double largest_of(const Ranks& ranks, double vote) {
  if (ranks.is_alone()) return vote;
  Votes votes{.least = {}, .largest = {vote}, .sum = {}};
  ranks.join(votes);
  return votes.largest[0];
}

std::uint64_t sum_of(const Ranks& ranks, std::uint64_t vote) {
  if (ranks.is_alone()) return vote;
  Votes votes{.least = {}, .largest = {}, .sum = {vote}};
  ranks.join(votes);
  return votes.sum[0];
}

NumericalError::Report report_of_one(const Ranks& ranks, NumericalError::Report own) {
  for (std::string* const text : {&own.what, &own.term, &own.place, &own.advice}) *text = ranks.gather(*text);
  return own;
}

void together(const Ranks& ranks, const std::function<void()>& act) {
  if (ranks.is_alone()) return act();
  NumericalError::Report own{};
  Votes votes{.least = {static_cast<double>(ranks.size())}, .largest = {}, .sum = {}};
  try {
    act();
  } catch (const NumericalError& error) {
    own = error.report(), votes.least[0] = ranks.rank();
  }
  ranks.join(votes);
  const int first = static_cast<int>(votes.least[0]);
  if (first < ranks.rank()) own = {};
  if (first < ranks.size()) throw NumericalError(report_of_one(ranks, own));
}

void join(const Ranks& ranks, Votes& votes, std::span<FixedVector> sums) {
  if (ranks.is_alone()) return;
  const std::size_t before = votes.sum.size();
  for (const FixedVector& sum : sums)
    for (const FixedPoint::Integer component : sum.component) add_digits(component, votes.sum);
  ranks.join(votes);
  const std::uint64_t* told = votes.sum.data() + before;
  for (FixedVector& sum : sums)
    for (FixedPoint::Integer& component : sum.component) component = sum_of_digits(told), told += digits;
  votes.sum.resize(before);
}

void sum_up(const Ranks& ranks, std::span<FixedVector> sums) {
  Votes none;
  if (!sums.empty()) join(ranks, none, sums);
}

void sum_up(const Ranks& ranks, FixedSums& sums) {
  if (ranks.is_alone() || sums.halves().empty()) return;
  Votes votes;
  const std::size_t count = sums.halves().size() / 2;
  for (std::size_t n = 0; n < count; ++n) add_digits(sums[n], votes.sum);
  ranks.join(votes);
  sums.clear();
  for (std::size_t n = 0; n < count; ++n) sums.add(n, sum_of_digits(votes.sum.data() + digits * n));
}

}  // namespace talus
