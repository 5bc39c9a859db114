// SPDX-License-Identifier: Apache-2.0
#include "models/air/part.hpp"

#include <array>

namespace talus::air {

namespace {

// In planes of rows. Third-order convection reads two velocities on either side, and the faces that are computed reach
// one beyond.
constexpr std::size_t before_midpoint = 2, after_midpoint = 3, around_known = 3;

}  // namespace

Part::Part(const Ranks& processes, const Grid& grid, const Slabs& slabs)
    : ranks(processes), all{{0, slabs.rows()}}, own{slabs.own()}, grid_(grid), slabs_(slabs) {
  const RowRange rows = slabs.own();
  const auto plane = static_cast<std::size_t>(grid.count[1]);
  // Whole planes, within which what is next along y lies, also if y is periodic.
  const auto around = [&](std::size_t before, std::size_t after) {
    if (rows.size() == 0) return std::vector<RowRange>{};
    return slabs.around({plane * before + rows.begin % plane, plane * (after + 1) - 1 - (rows.end - 1) % plane});
  };
  with_next = around(0, 1), beside = around(1, 1);
  midpoint = around(before_midpoint, after_midpoint), known = around(around_known, around_known);
  around_ = halo(known);
}

Halo Part::halo(std::span<const RowRange> needed) const {
  constexpr int m = Grid::margin;
  const int ny = grid_.count[1], nz = grid_.count[2];
  // Ghosts along y go with the row next to them, planes of ghosts with the first and the last row.
  return slabs_.halo(needed, [&](std::size_t row, std::vector<std::uint32_t>& rows) {
    const int j = static_cast<int>(row) % ny, k = static_cast<int>(row) / ny;
    const auto add = [&](int low, int high, int plane) {
      for (int at = low; at < high; ++at) rows.push_back(static_cast<std::uint32_t>(grid_.row(at, plane)));
    };
    if (row == 0)
      for (int plane = -m; plane < 0; ++plane) add(-m, ny + m, plane);
    add(j == 0 ? -m : j, j == ny - 1 ? ny + m : j + 1, k);
    if (row + 1 == slabs_.rows())
      for (int plane = nz; plane < nz + m; ++plane) add(-m, ny + m, plane);
  });
}

void Part::refresh(std::span<CellField* const> fields) {
  if (ranks.is_alone()) return;
  std::vector<Halo::Column> columns;
  for (CellField* const field : fields) columns.push_back(rows_of(grid_, *field));
  around_.refresh(columns);
}

void Part::gather(std::span<CellField* const> fields) const {
  if (ranks.is_alone()) return;
  Halo at_first = halo(ranks.is_first() ? all : std::vector<RowRange>{});
  for (CellField* const field : fields) at_first.refresh(std::array{rows_of(grid_, *field)});
}

}  // namespace talus::air
