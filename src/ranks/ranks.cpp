// SPDX-License-Identifier: Apache-2.0
#include "ranks/ranks.hpp"

namespace talus {

namespace {

// A sum of 128 bits is told in digits: sums of up to 2^32 processes do not overflow, and carries follow at the end.
constexpr int digit_bits = 32;
constexpr std::size_t digits = 4;

void sum_integers(const Ranks& ranks, std::vector<FixedPoint::Integer>& sums) {
  if (ranks.is_alone() || sums.empty()) return;
  Votes votes;
  for (const FixedPoint::Integer sum : sums)
    for (std::size_t d = 0; d < digits; ++d)
      votes.sum.push_back(static_cast<std::uint32_t>(sum >> (digit_bits * static_cast<int>(d))));
  ranks.join(votes);
  for (std::size_t n = 0; n < sums.size(); ++n) {
    sums[n] = 0;
    for (std::size_t d = 0; d < digits; ++d)
      sums[n] += static_cast<FixedPoint::Integer>(votes.sum[digits * n + d]) << (digit_bits * static_cast<int>(d));
  }
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

void sum_up(const Ranks& ranks, std::span<FixedVector> sums) {
  if (ranks.is_alone()) return;
  std::vector<FixedPoint::Integer> all;
  for (const FixedVector& sum : sums) all.insert(all.end(), sum.component.begin(), sum.component.end());
  sum_integers(ranks, all);
  std::size_t n = 0;
  for (FixedVector& sum : sums)
    for (FixedPoint::Integer& component : sum.component) component = all[n++];
}

void sum_up(const Ranks& ranks, FixedSums& sums) {
  if (ranks.is_alone()) return;
  std::vector<FixedPoint::Integer> all;
  for (std::size_t n = 0; n < sums.halves().size() / 2; ++n) all.push_back(sums[n]);
  sum_integers(ranks, all);
  sums.clear();
  for (std::size_t n = 0; n < all.size(); ++n) sums.add(n, all[n]);
}

}  // namespace talus
