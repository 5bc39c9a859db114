// SPDX-License-Identifier: Apache-2.0
#include "numerics/snapshot.hpp"

#include <algorithm>
#include <stdexcept>

namespace talus {

namespace {

template <class T>
std::span<const T> column(const Snapshot& snapshot, std::string_view name) {
  std::string present;
  for (const ColumnView& candidate : snapshot.columns) {
    if (candidate.name == name) {
      if (const auto* values = std::get_if<std::span<const T>>(&candidate.values)) return *values;
      throw std::out_of_range("column '" + std::string(name) + "' is of another type");
    }
    present += (present.empty() ? "" : ", ") + std::string(candidate.name);
  }
  throw std::out_of_range("no column '" + std::string(name) + "'; there are: " + present);
}

}  // namespace

std::size_t Snapshot::size() const {
  return columns.empty() ? 0 : positions().size();
}
std::span<const double> Snapshot::scalars(std::string_view name) const {
  return column<double>(*this, name);
}
std::span<const Vector3> Snapshot::vectors(std::string_view name) const {
  return column<Vector3>(*this, name);
}
std::span<const std::int64_t> Snapshot::integers(std::string_view name) const {
  return column<std::int64_t>(*this, name);
}
bool Snapshot::has(std::string_view name) const {
  return std::any_of(columns.begin(), columns.end(), [&](const ColumnView& column) { return column.name == name; });
}

Snapshot PointSet::view() const {
  Snapshot snapshot{.time = time, .step = step, .columns = {}, .domain = nullptr, .copies = copies};
  for (const Column& column : columns)
    snapshot.columns.push_back(
        {column.name, column.unit,
         std::visit([](const auto& values) -> decltype(ColumnView::values) { return std::span(values); },
                    column.values)});
  return snapshot;
}

}  // namespace talus
