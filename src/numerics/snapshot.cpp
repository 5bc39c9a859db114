// SPDX-License-Identifier: Apache-2.0
#include "numerics/snapshot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/tensor.hpp"
#include "numerics/geometry/sector.hpp"

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

ColumnSource source_of(const ColumnView& column) {
  return std::visit(
      [&](const auto values) {
        using Entry = std::remove_cv_t<typename decltype(values)::element_type>;
        return ColumnSource{std::string(column.name), std::string(column.unit), kind_of<Entry>,
                            [values](std::size_t first, std::size_t count, std::byte* to) {
                              if (count > 0) std::memcpy(to, values.data() + first, count * sizeof(Entry));
                            }};
      },
      column.values);
}

PointSource source_of(const Snapshot& snapshot) {
  PointSource source{snapshot.time, snapshot.step, snapshot.size(), {}, snapshot.copies};
  for (const ColumnView& column : snapshot.columns) {
    const std::size_t entries = std::visit([](const auto& values) { return values.size(); }, column.values);
    if (entries != source.count)
      throw std::invalid_argument("snapshot: column '" + std::string(column.name) + "' has " + std::to_string(entries) +
                                  " entries for " + std::to_string(source.count) + " particles");
    source.columns.push_back(source_of(column));
  }
  return source;
}

PointSet points_of(const PointSource& source, std::size_t first, std::size_t count,
                   std::span<const std::string> names) {
  PointSet points{source.time, source.step, {}, source.copies};
  for (const ColumnSource& column : source.columns) {
    if (!names.empty() && std::find(names.begin(), names.end(), column.name) == names.end()) continue;
    const auto add = [&](auto values) {
      column.read(first, count, reinterpret_cast<std::byte*>(values.data()));
      points.columns.push_back({column.name, column.unit, std::move(values)});
    };
    if (column.kind == ColumnSource::Kind::vector)
      add(std::vector<Vector3>(count));
    else if (column.kind == ColumnSource::Kind::real)
      add(std::vector<double>(count));
    else
      add(std::vector<std::int64_t>(count));
  }
  return points;
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

namespace {

template <class Values>
const Values& column(const GridSnapshot& snapshot, std::string_view name) {
  for (const GridSnapshot::Column& column : snapshot.columns)
    if (column.name == name)
      if (const auto* values = std::get_if<Values>(&column.values)) return *values;
  throw std::out_of_range("the grid has no such column '" + std::string(name) + "'");
}

}  // namespace

int GridSnapshot::cell_at(int axis, double coordinate) const {
  const int cell = static_cast<int>(std::floor((coordinate - low[axis]) / spacing[axis]));
  return std::clamp(cell, 0, count[static_cast<std::size_t>(axis)] - 1);
}

const std::vector<double>& GridSnapshot::scalars(std::string_view name) const {
  return column<std::vector<double>>(*this, name);
}

const std::vector<Vector3>& GridSnapshot::vectors(std::string_view name) const {
  return column<std::vector<Vector3>>(*this, name);
}

namespace {

constexpr std::array<std::string_view, 6> components{"_xx", "_yy", "_zz", "_xy", "_yz", "_zx"};

/// The columns of tensors, in the order of SymmetricTensor3, by the name without component.
std::map<std::string, std::array<std::span<const double>, 6>> tensors_of(const Snapshot& part) {
  std::map<std::string, std::array<std::span<const double>, 6>> tensors;
  for (const ColumnView& column : part.columns) {
    if (!column.name.ends_with(components[0])) continue;
    const std::string base(column.name.substr(0, column.name.size() - components[0].size()));
    std::array<std::span<const double>, 6> of;
    bool is_whole = true;
    for (std::size_t n = 0; n < components.size(); ++n) {
      const std::string name = base + std::string(components[n]);
      const auto found =
          std::find_if(part.columns.begin(), part.columns.end(), [&](const ColumnView& c) { return c.name == name; });
      const auto* values = found != part.columns.end() ? std::get_if<std::span<const double>>(&found->values) : nullptr;
      if (values) of[n] = *values;
      is_whole = is_whole && values;
    }
    if (is_whole) tensors.emplace(base, of);
  }
  return tensors;
}

}  // namespace

PointSet whole_of(const Snapshot& part, std::span<const std::string> columns) {
  const SectorCopies& copies = part.copies.value();
  const Sector sector(copies.axis, copies.count);
  const std::size_t own = part.size();
  const auto tensors = tensors_of(part);
  PointSet whole{.time = part.time, .step = part.step, .columns = {}};
  /// Writes value(i, k) of particle i in copy k.
  const auto add = [&](const ColumnView& column, const auto& value) {
    std::vector<std::decay_t<decltype(value(std::size_t{0}, 0))>> values(own * static_cast<std::size_t>(copies.count));
    for (int k = 0; k < copies.count; ++k)
      for (std::size_t i = 0; i < own; ++i) values[static_cast<std::size_t>(k) * own + i] = value(i, k);
    whole.columns.push_back({std::string(column.name), std::string(column.unit), std::move(values)});
  };
  for (const ColumnView& column : part.columns) {
    if (!columns.empty() && std::find(columns.begin(), columns.end(), column.name) == columns.end()) continue;
    if (const auto* vectors = std::get_if<std::span<const Vector3>>(&column.values)) {
      const bool is_position = column.name == "position";
      add(column, [&](std::size_t i, int k) {
        return is_position ? sector.turned((*vectors)[i], k) : sector.turn(k) * (*vectors)[i];
      });
    } else if (const auto* integers = std::get_if<std::span<const std::int64_t>>(&column.values)) {
      const std::int64_t all = copies.identities * copies.count;
      add(column, [&](std::size_t i, int k) {
        return column.name == "identity" && all > 0 ? ((*integers)[i] + k * copies.identities) % all : (*integers)[i];
      });
    } else {
      const auto scalars = std::get<std::span<const double>>(column.values);
      const std::size_t cut = column.name.size() < 3 ? 0 : column.name.size() - 3;
      const auto tensor = tensors.find(std::string(column.name.substr(0, cut)));
      const auto component = std::find(components.begin(), components.end(), column.name.substr(cut));
      if (tensor == tensors.end() || component == components.end()) {
        add(column, [&](std::size_t i, int) { return scalars[i]; });
        continue;
      }
      const auto& of = tensor->second;
      const auto number = component - components.begin();
      add(column, [&](std::size_t i, int k) {
        const SymmetricTensor3<> t =
            transformed({of[0][i], of[1][i], of[2][i], of[3][i], of[4][i], of[5][i]}, sector.turn(k));
        const double all[6] = {t.xx, t.yy, t.zz, t.xy, t.yz, t.zx};
        return all[number];
      });
    }
  }
  return whole;
}

}  // namespace talus
