// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/distinct_rows.hpp"

#include <gtest/gtest.h>

namespace talus {
namespace {

TEST(DistinctRows, HoldEachRowOnceAndAllRowsAreThoseOfTheField) {
  const Grid grid{.count = {5, 3, 7}, .low = {}, .spacing = {1, 1, 1}};
  CellField field = grid.cell_field();
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = -1; i < 6; ++i) field[grid.index(i, j, k)] = k < 4 ? 0 : 1 + (i == 2 && j == 1 && k == 6);
  const DistinctRows rows(grid, field);
  EXPECT_EQ(rows.count(), 3u);  // of zeros, of ones, and one with a 2
  for (int k = -Grid::margin; k < 7 + Grid::margin; ++k)
    for (int j = -Grid::margin; j < 3 + Grid::margin; ++j) {
      const std::size_t row = grid.row(j, k);
      EXPECT_EQ(rows.is_zero(row), j < 0 || j >= 3 || k < 4 || k >= 7) << j << ' ' << k;
      for (int i = -Grid::margin; i < 5 + Grid::margin; ++i)
        EXPECT_EQ(rows.at(row)[i], field[grid.index(i, j, k)]) << i << ' ' << j << ' ' << k;
    }
}

}  // namespace
}  // namespace talus
