// SPDX-License-Identifier: Apache-2.0
/// Numbers of a whole system over time: one column per quantity, one row per step.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

struct Series {
  std::vector<std::string> names;            ///< unique
  std::vector<std::string> units;            ///< SI, one per column; "1" for numbers
  std::vector<std::vector<double>> columns;  ///< all of the same length

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  bool has(std::string_view name) const;
  /// \throws std::out_of_range naming the column and those that are there
  std::span<const double> column(std::string_view name) const;
};

}  // namespace talus
