// SPDX-License-Identifier: Apache-2.0
#include "ranks/slabs.hpp"

#include <array>
#include <utility>

namespace talus {

namespace {

constexpr std::size_t most_slabs = 2;  // that a process needs

RowRange common(const RowRange& a, const RowRange& b) {
  const std::size_t begin = std::max(a.begin, b.begin);
  return {begin, std::max(begin, std::min(a.end, b.end))};
}

}  // namespace

Slabs::Slabs(const Ranks& ranks, std::vector<std::size_t> border, bool is_ring)
    : ranks_(&ranks), border_(std::move(border)), is_ring_(is_ring) {}

std::vector<RowRange> Slabs::around(const Reach& reach) const {
  const RowRange mine = own();
  const std::size_t length = mine.size() + reach.before + reach.after;
  if (length == 0) return {};
  if (length >= rows() && is_ring_) return {{0, rows()}};
  const std::size_t begin = mine.begin - std::min(mine.begin, reach.before);
  const std::size_t end = std::min(rows(), mine.end + reach.after);
  if (is_ring_ && reach.before > mine.begin) return {{0, end}, {rows() - (reach.before - mine.begin), rows()}};
  if (is_ring_ && mine.end + reach.after > rows()) return {{0, mine.end + reach.after - rows()}, {begin, rows()}};
  return {{begin, end}};
}

void Slabs::include(std::size_t row, Reach& reach) const {
  const RowRange mine = own();
  if (row >= mine.begin && row < mine.end) return;
  // How far back and on it is, on a ring either way.
  std::size_t back = mine.begin > row ? mine.begin - row : is_ring_ ? mine.begin + rows() - row : rows();
  std::size_t on = row >= mine.end ? row + 1 - mine.end : is_ring_ ? row + 1 + rows() - mine.end : rows();
  if (back <= on)
    reach.before = std::max(reach.before, back);
  else
    reach.after = std::max(reach.after, on);
}

Halo Slabs::halo(std::span<const RowRange> needed, const ElementsOfRow& elements) const {
  if (ranks_->is_alone()) return {};
  std::vector<RowRange> told(needed.begin(), needed.end());
  told.resize(most_slabs);
  const std::vector<RowRange> all = ranks_->gather_values(told);
  const auto rows_between = [&](int owner, std::span<const RowRange> wanted, std::vector<std::uint32_t>& to) {
    for (const RowRange& some : wanted) {
      const RowRange rows = common(some, of(owner));
      for (std::size_t row = rows.begin; row < rows.end; ++row) elements(row, to);
    }
  };
  std::vector<std::uint32_t> sent, received;
  std::vector<std::size_t> counts;
  for (int rank = 0; rank < ranks_->size(); ++rank) {
    const std::size_t before = sent.size();
    const auto wanted = std::span(all).subspan(most_slabs * static_cast<std::size_t>(rank), most_slabs);
    if (rank != ranks_->rank()) {
      rows_between(ranks_->rank(), wanted, sent);
      rows_between(rank, told, received);
    }
    counts.push_back(sent.size() - before);
  }
  return {ranks_->plan(counts), std::move(sent), std::move(received)};
}

Halo Slabs::halo(std::span<const RowRange> needed) const {
  return halo(needed, [](std::size_t row, std::vector<std::uint32_t>& elements) {
    elements.push_back(static_cast<std::uint32_t>(row));
  });
}

}  // namespace talus
