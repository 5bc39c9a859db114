// SPDX-License-Identifier: Apache-2.0
/// Which rows a process computes of the levels of the multigrid, and what it is told of others.
#include "numerics/grid/joined_rows.hpp"
#include "numerics/grid/multigrid.hpp"

namespace talus {

/// The fine rows whose residuals and conductances the own coarse rows join.
Slabs::Reach Multigrid::joined_rows(const Level& fine, const Level& coarse) {
  Slabs::Reach reach;
  const Aggregates& aggregates = fine.aggregates;
  const RowRange own = coarse.slabs.own();
  for (std::size_t r = own.begin; r < own.end; ++r) {
    for_each_joined_row(fine.board, coarse.board, fine.factor, r,
                        [&](std::size_t row, bool, bool) { fine.slabs.include(row, reach); });
    if (aggregates.empty()) continue;
    const auto& cells = aggregates.cells;
    for (auto n = cells.begin[cells.of_row[r]]; n < cells.begin[cells.of_row[r + 1]]; ++n)
      fine.slabs.include(cells.parts[n].row, reach);
    for (const auto& faces : aggregates.faces)
      for (auto n = faces.begin[faces.of_row[r]]; n < faces.begin[faces.of_row[r + 1]]; ++n)
        fine.slabs.include(fine.board.row_at(faces.parts[n].index), reach);
  }
  return reach;
}

/// The coarse rows that the fine rows which are corrected take their corrections from.
Slabs::Reach Multigrid::joining_rows(const Level& fine, const Level& coarse) {
  Slabs::Reach reach;
  for (const RowRange& rows : fine.rows.corrected)
    for (std::size_t r = rows.begin; r < rows.end; ++r) {
      coarse.slabs.include(joining_row(fine.board, coarse.board, fine.factor, r), reach);
      if (fine.aggregates.empty()) continue;
      for (auto n = fine.aggregates.moved_of_row[r]; n < fine.aggregates.moved_of_row[r + 1]; ++n)
        if (const std::size_t row = coarse.board.row_at(fine.aggregates.moved[n].coarse); row < coarse.board.rows())
          coarse.slabs.include(row, reach);
    }
  return reach;
}

/// Sweeps end where their values are read, and begin a row of neighbours farther each: the last red ones on the own
/// rows, of the finest level on their neighbours too.
void Multigrid::plan(std::size_t l) {
  Level& level = levels_[l];
  const bool is_coarsest = l + 1 == levels_.size();
  const auto at = [&](const Slabs::Reach& reach) { return level.slabs.around(reach); };
  const std::size_t next = level.board.reach();
  const bool is_any = level.slabs.own().size() > 0;
  const Slabs::Reach last = {}, before = is_any ? last.more(next) : last;
  const Slabs::Reach last_red = l == 0 ? before : last;
  const Slabs::Reach last_black = is_any ? last_red.more(next) : last,
                     corrected = is_any ? last_black.more(next) : last;
  Slabs::Reach first_black, first_red = corrected;
  if (!is_coarsest && levels_[l + 1].slabs.own().size() > 0) {
    first_black = joined_rows(level, levels_[l + 1]).more(next);
    first_red = first_red.with(first_black.more(next));
  }
  level.rows = {.restricted = {level.slabs.own()},
                .known = at(first_red.more(next)),
                .first_red = at(first_red),
                .first_black = at(first_black),
                .corrected = at(corrected),
                .last_black = at(last_black),
                .last_red = at(last_red)};
  level.known = level.slabs.halo(level.rows.known);
  if (is_coarsest) level.values = level.slabs.halo(at(corrected.more(next)));
}

void Multigrid::plan() {
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    if (level.is_shared) {
      plan(l);
    } else {  // all compute all of it, once they have told each other of what they have restricted
      const std::vector<RowRange> all{level.all()};
      level.rows = {{level.slabs.own()}, all, all, all, all, all, all};
      level.known = level.slabs.halo(all);
    }
    if (l > 0 && level.is_shared)
      level.values = level.slabs.halo(level.slabs.around(joining_rows(levels_[l - 1], level)));
  }
}

}  // namespace talus
