// SPDX-License-Identifier: Apache-2.0
/// A field of a grid that hardly varies, as its distinct rows along x: most rows of what walls and boundaries leave
/// open are alike, so that a loop over rows finds them in the nearest cache.
#pragma once

#include <cstdint>
#include <vector>

#include "numerics/grid/grid.hpp"

namespace talus {

class DistinctRows {
 public:
  DistinctRows() = default;
  DistinctRows(const Grid& grid, const CellField& field);

  /// The row of the field with this number (Grid::row), from the first cell on; readable from the first to the last
  /// ghost.
  const double* at(std::size_t row) const { return numbers_.data() + start_[row]; }
  /// Whether the row, ghosts included, is zero.
  bool is_zero(std::size_t row) const { return start_[row] == zero_; }
  std::size_t count() const { return numbers_.size() / length_; }

 private:
  std::size_t length_ = 1;
  std::vector<double> numbers_;
  std::vector<std::size_t> start_;                   // of each row, in `numbers_`, past the ghosts
  std::size_t zero_ = static_cast<std::size_t>(-1);  // start of the row of zeros
};

}  // namespace talus
