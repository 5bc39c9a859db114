// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid/distinct_rows.hpp"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace talus {

DistinctRows::DistinctRows(const Grid& grid, const CellField& field) : length_(grid.length(0)) {
  // Rows as bytes: equal ones have equal bits.
  std::unordered_map<std::string_view, std::size_t> known;
  for (std::size_t begin = 0; begin < field.size(); begin += length_) {
    const double* row = field.data() + begin;
    const std::string_view bytes(reinterpret_cast<const char*>(row), length_ * sizeof(double));
    const auto [found, is_new] = known.try_emplace(bytes, numbers_.size() + Grid::margin);
    start_.push_back(found->second);
    if (!is_new) continue;
    if (std::all_of(row, row + length_, [](double x) { return x == 0; })) zero_ = found->second;
    numbers_.insert(numbers_.end(), row, row + length_);
  }
}

}  // namespace talus
