// SPDX-License-Identifier: Apache-2.0
/// Rows of a grid, dealt to processes: each owns a slab, rows that follow each other, and needs some before and after
/// it that others own. Who owns what changes no bit of what is computed from a row and those around it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "ranks/halo.hpp"
#include "ranks/ranks.hpp"

namespace talus {

/// Rows [begin, end).
struct RowRange {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

class Slabs {
 public:
  /// How many rows before and after its own a process needs.
  struct Reach {
    std::size_t before = 0, after = 0;
    Reach more(std::size_t rows) const { return {before + rows, after + rows}; }
    Reach with(const Reach& other) const { return {std::max(before, other.before), std::max(after, other.after)}; }
  };
  /// The numbers of the elements of a row in a column, rising.
  using ElementsOfRow = std::function<void(std::size_t row, std::vector<std::uint32_t>& elements)>;

  /// All rows are this process's.
  explicit Slabs(std::size_t rows = 0) : border_{0, rows} {}
  /// \param border of the slabs: 0, the first row of the second process, ..., the number of rows
  /// \param is_ring whether the first row follows the last one; \param ranks outlive the slabs
  Slabs(const Ranks& ranks, std::vector<std::size_t> border, bool is_ring);

  std::size_t rows() const { return border_.back(); }
  const std::vector<std::size_t>& border() const { return border_; }
  RowRange own() const { return of(ranks_->rank()); }
  /// The own rows and those within reach of them, each once: one slab, or two on a ring; none for no rows.
  std::vector<RowRange> around(const Reach& reach) const;
  /// Widens the reach, the shorter way on a ring, if it leaves a row out.
  void include(std::size_t row, Reach& reach) const;

  /// Together: brings rows that others own. \param needed disjoint slabs, at most two; the own rows among them do not
  /// matter
  Halo halo(std::span<const RowRange> needed, const ElementsOfRow& elements) const;
  /// The same where the element of a row has its number.
  Halo halo(std::span<const RowRange> needed) const;

 private:
  RowRange of(int rank) const {
    const auto r = static_cast<std::size_t>(rank);
    return {border_[r], border_[r + 1]};
  }

  const Ranks* ranks_ = &one_process();
  std::vector<std::size_t> border_;
  bool is_ring_ = false;
};

/// Calls body(block, begin, end) for the parts of slabs in blocks of so many rows, counted from row 0.
template <class Body>
void for_each_block(ThreadTeam& team, std::span<const RowRange> slabs, std::size_t rows_of_block, Body&& body) {
  for (const RowRange& slab : slabs) {
    const std::size_t first = slab.begin / rows_of_block;
    const std::size_t blocks = slab.size() == 0 ? 0 : (slab.end + rows_of_block - 1) / rows_of_block - first;
    team.run(blocks, [&](std::size_t n) {
      const std::size_t block = first + n;
      body(block, std::max(slab.begin, block * rows_of_block), std::min(slab.end, (block + 1) * rows_of_block));
    });
  }
}

}  // namespace talus
