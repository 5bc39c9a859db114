// SPDX-License-Identifier: Apache-2.0
#include "io/vtkhdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

#include "base/error.hpp"
#include "io/file.hpp"
#include "io/hdf5.hpp"

namespace talus {

namespace {

const std::string point_data = vtkhdf_root + "/PointData";

std::vector<double> numbers(const Vector3& v) {
  return {v.x, v.y, v.z};
}

/// The image's points: the centres of the cells, and along an axis of one cell its two faces.
struct Points {
  std::array<std::size_t, 3> count;  ///< along x, y, z
  Vector3 origin;

  explicit Points(const GridSnapshot& grid) : origin(grid.centre(0, 0, 0)) {
    for (std::size_t a = 0; a < 3; ++a) {
      const bool is_one = grid.count[a] == 1;
      count[a] = is_one ? 2 : static_cast<std::size_t>(grid.count[a]);
      if (is_one) origin[static_cast<int>(a)] = grid.low[static_cast<int>(a)];
    }
  }

  /// The cells' values, x fastest; an only cell's at both of its faces.
  template <class Value>
  std::vector<Value> values(const GridSnapshot& grid, const std::vector<Value>& of_cells) const {
    const auto cell = [&](std::size_t a, std::size_t point) {
      return grid.count[a] == 1 ? 0 : static_cast<int>(point);
    };
    std::vector<Value> all;
    all.reserve(count[0] * count[1] * count[2]);
    for (std::size_t k = 0; k < count[2]; ++k)
      for (std::size_t j = 0; j < count[1]; ++j)
        for (std::size_t i = 0; i < count[0]; ++i)
          all.push_back(of_cells[grid.index(cell(0, i), cell(1, j), cell(2, k))]);
    return all;
  }
};

/// The cells' values from the points' values.
template <class Value>
std::vector<Value> of_cells(const GridSnapshot& grid, const std::array<std::size_t, 3>& points,
                            const std::vector<Value>& values) {
  std::vector<Value> cells;
  cells.reserve(grid.cells());
  for (std::size_t k = 0; k < static_cast<std::size_t>(grid.count[2]); ++k)
    for (std::size_t j = 0; j < static_cast<std::size_t>(grid.count[1]); ++j)
      for (std::size_t i = 0; i < static_cast<std::size_t>(grid.count[0]); ++i)
        cells.push_back(values[i + points[0] * (j + points[1] * k)]);
  return cells;
}

}  // namespace

void write_grid(const std::filesystem::path& path, const GridSnapshot& snapshot) {
  hdf5::Writer file(path);
  file.group(vtkhdf_root);
  file.attribute(vtkhdf_root, "Type", "ImageData");
  file.attribute(vtkhdf_root, "Version", std::vector<std::int64_t>{1, 0});
  const Points points(snapshot);
  const auto& n = points.count;
  const auto last = [&](std::size_t a) { return static_cast<std::int64_t>(n[a]) - 1; };
  file.attribute(vtkhdf_root, "WholeExtent", std::vector<std::int64_t>{0, last(0), 0, last(1), 0, last(2)});
  file.attribute(vtkhdf_root, "cells", std::vector<std::int64_t>(snapshot.count.begin(), snapshot.count.end()));
  file.attribute(vtkhdf_root, "Origin", numbers(points.origin));
  file.attribute(vtkhdf_root, "Spacing", numbers(snapshot.spacing));
  file.attribute(vtkhdf_root, "Direction", std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  file.attribute(vtkhdf_root, "time", std::vector<double>{snapshot.time});
  file.attribute(vtkhdf_root, "step", std::vector<std::int64_t>{static_cast<std::int64_t>(snapshot.step)});

  file.group(point_data);
  const std::array<std::size_t, 3> shape{n[2], n[1], n[0]};
  for (const GridSnapshot::Column& column : snapshot.columns)
    std::visit(
        [&](const auto& values) {
          if (values.size() != snapshot.cells())
            throw std::invalid_argument(fmt::format("snapshot: column '{}' has {} entries for {} cells", column.name,
                                                    values.size(), snapshot.cells()));
          const auto all = points.values(snapshot, values);
          file.write_grid(point_data + "/" + column.name, shape, std::span(all), column.unit);
        },
        column.values);
  file.save();
}

GridSnapshot read_grid(const std::filesystem::path& path) {
  const hdf5::Reader file(path);
  const auto refuse = [&](const char* what) { throw FileError(path.string(), what); };
  if (!file.has(vtkhdf_root) || file.text_attribute(vtkhdf_root, "Type") != "ImageData")
    refuse("holds no grid of cells");
  const std::vector<std::int64_t> extent = file.integer_attribute(vtkhdf_root, "WholeExtent");
  const std::vector<double> origin = file.real_attribute(vtkhdf_root, "Origin");
  const std::vector<double> spacing = file.real_attribute(vtkhdf_root, "Spacing");
  if (extent.size() != 6 || origin.size() != 3 || spacing.size() != 3) refuse("lacks extent, origin or spacing");
  GridSnapshot snapshot;
  std::array<std::size_t, 3> points{};
  const std::vector<std::int64_t> cells =
      file.integer_attribute(vtkhdf_root, "cells");  // since 0.5; before, the points
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t count = extent[2 * a + 1] - extent[2 * a] + 1;
    points[a] = static_cast<std::size_t>(std::max<std::int64_t>(count, 0));
    snapshot.count[a] = static_cast<int>(cells.size() == 3 ? cells[a] : count);
    if (count < 1 || (snapshot.count[a] != count && !(snapshot.count[a] == 1 && count == 2)))
      refuse("has an extent that does not fit its cells");
    const int axis = static_cast<int>(a);
    snapshot.spacing[axis] = spacing[a];
    snapshot.low[axis] = origin[a] - (snapshot.count[a] == count ? 0.5 * spacing[a] : 0);
  }
  for (const std::string& name : file.names(point_data)) {
    const std::string data = point_data + "/" + name;
    const hdf5::Description description = file.describe(data);
    const std::size_t components = description.shape.size() == 4 ? description.shape[3] : 1;
    const std::vector<double> all = file.doubles(data);
    if ((components != 1 && components != 3) || all.size() != components * points[0] * points[1] * points[2])
      refuse("has a column that does not fit its cells");
    GridSnapshot::Column column{name, file.text_attribute(data, "units"), {}};
    if (components == 3) {
      std::vector<Vector3> values(all.size() / 3);
      for (std::size_t c = 0; c < values.size(); ++c) values[c] = {all[3 * c], all[3 * c + 1], all[3 * c + 2]};
      column.values = of_cells(snapshot, points, values);
    } else {
      column.values = of_cells(snapshot, points, all);
    }
    snapshot.columns.push_back(std::move(column));
  }
  const std::vector<double> time = file.real_attribute(vtkhdf_root, "time");
  const std::vector<std::int64_t> step = file.integer_attribute(vtkhdf_root, "step");
  if (time.size() != 1 || step.size() != 1) refuse("holds no single time");
  snapshot.time = time[0], snapshot.step = static_cast<std::uint64_t>(step[0]);
  return snapshot;
}

}  // namespace talus
