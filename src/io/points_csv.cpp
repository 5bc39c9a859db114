// SPDX-License-Identifier: Apache-2.0
#include "io/points_csv.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace talus {

namespace {

std::vector<Vector3> vectors(std::size_t count, const CsvColumn* x, const CsvColumn* y, const CsvColumn* z) {
  std::vector<Vector3> vectors(count);
  for (std::size_t i = 0; i < count; ++i)
    vectors[i] = {x ? x->values[i] : 0, y ? y->values[i] : 0, z ? z->values[i] : 0};
  return vectors;
}

/// The columns as the header orders them, those of a vector at the position of its first.
PointSet points_of(const CsvTable& table) {
  const std::size_t count = table.lines.size();
  PointSet points;
  points.columns.push_back({"position", "m", vectors(count, table.find("x"), table.find("y"), table.find("z"))});
  for (const CsvColumn& column : table.columns) {
    const std::string& name = column.name;
    if (name == "x" || name == "y" || name == "z") continue;
    const std::string stem = name.size() > 2 && name[name.size() - 2] == '_' ? name.substr(0, name.size() - 2) : "";
    const CsvColumn *x = table.find(stem + "_x"), *y = table.find(stem + "_y"), *z = table.find(stem + "_z");
    const bool is_vector = !stem.empty() && x && y && z && x->unit == y->unit && y->unit == z->unit;
    if (!is_vector || (&column != x && &column != y && &column != z))
      points.columns.push_back({name, column.unit, column.values});
    else if (&column == std::min({x, y, z}))
      points.columns.push_back({stem, column.unit, vectors(count, x, y, z)});
  }
  return points;
}

constexpr KnownColumn lengths[] = {
    {"x", dimension::length}, {"y", dimension::length}, {"z", dimension::length}, {"radius", dimension::length}};
constexpr ColumnAlias aliases[] = {{"r", "radius"}, {"diameter", "radius", 0.5}};
constexpr std::string_view header = "x [mm], y [mm], z [mm], radius [mm], ...";

}  // namespace

PointSet read_points_csv(const std::filesystem::path& path, std::span<const std::string_view> required) {
  std::vector<std::string_view> all{"x"};
  all.insert(all.end(), required.begin(), required.end());
  return points_of(read_csv_table(path, {.known = lengths, .aliases = aliases, .required = all, .header = header}));
}

GivenPoints read_given_points(const std::filesystem::path& path, std::span<const KnownColumn> others,
                              std::span<const RefusedColumn> refused) {
  static constexpr std::string_view required[] = {"x"};
  std::vector<KnownColumn> known(std::begin(lengths), std::end(lengths));
  known.insert(known.end(), others.begin(), others.end());
  const CsvTable table = read_csv_table(path, {.known = known,
                                               .aliases = aliases,
                                               .refused = refused,
                                               .required = required,
                                               .known_only = true,
                                               .header = header});
  GivenPoints given{points_of(table), {}};
  for (const KnownColumn& length : lengths)
    if (const CsvColumn* const column = table.find(length.name); column && !column->has_unit)
      given.without_unit.emplace_back(length.name);
  return given;
}

}  // namespace talus
