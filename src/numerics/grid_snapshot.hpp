// SPDX-License-Identifier: Apache-2.0
/// Values in the cells of a regular grid at one time: what files and analysis see of the air.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vector.hpp"

namespace talus {

struct GridSnapshot {
  struct Column {
    std::string name;
    std::string unit;
    std::variant<std::vector<double>, std::vector<Vector3>> values;  ///< one per cell, x fastest
  };
  double time = 0;  ///< s
  std::uint64_t step = 0;
  std::array<int, 3> count{};  ///< cells along x, y, z
  Vector3 low, spacing;        ///< corner, and size of a cell, m
  std::vector<Column> columns;

  std::size_t cells() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(count[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(k));
  }
  Vector3 centre(int i, int j, int k) const {
    return low + Vector3{(i + 0.5) * spacing.x, (j + 0.5) * spacing.y, (k + 0.5) * spacing.z};
  }
  /// The cell along an axis that holds a place; the last one for a place beyond it.
  int cell_at(int axis, double place) const;

  /// \throws std::out_of_range naming the column
  const std::vector<double>& scalars(std::string_view name) const;
  const std::vector<Vector3>& vectors(std::string_view name) const;
};

}  // namespace talus
