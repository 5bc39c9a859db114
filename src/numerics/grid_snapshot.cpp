// SPDX-License-Identifier: Apache-2.0
#include "numerics/grid_snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

namespace {

template <class Values>
const Values& column(const GridSnapshot& snapshot, std::string_view name) {
  for (const GridSnapshot::Column& column : snapshot.columns)
    if (column.name == name)
      if (const auto* values = std::get_if<Values>(&column.values)) return *values;
  throw std::out_of_range("the grid has no such column '" + std::string(name) + "'");
}

}  // namespace

int GridSnapshot::cell_at(int axis, double place) const {
  const int cell = static_cast<int>(std::floor((place - low[axis]) / spacing[axis]));
  return std::clamp(cell, 0, count[static_cast<std::size_t>(axis)] - 1);
}

const std::vector<double>& GridSnapshot::scalars(std::string_view name) const {
  return column<std::vector<double>>(*this, name);
}

const std::vector<Vector3>& GridSnapshot::vectors(std::string_view name) const {
  return column<std::vector<Vector3>>(*this, name);
}

}  // namespace talus
