// SPDX-License-Identifier: Apache-2.0
#include "io/vtkhdf_grid.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5.hpp"

namespace talus {

namespace {

const std::string root = "VTKHDF";
const std::string point_data = root + "/PointData";

std::vector<double> numbers(const Vector3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

void write_grid(const std::filesystem::path& path, const GridSnapshot& snapshot) {
  hdf5::Writer file(path);
  file.group(root);
  file.attribute(root, "Type", "ImageData");
  file.attribute(root, "Version", std::vector<std::int64_t>{1, 0});
  const auto& n = snapshot.count;
  file.attribute(root, "WholeExtent", std::vector<std::int64_t>{0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1});
  file.attribute(root, "Origin", numbers(snapshot.centre(0, 0, 0)));
  file.attribute(root, "Spacing", numbers(snapshot.spacing));
  file.attribute(root, "Direction", std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  file.attribute(root, "time", std::vector<double>{snapshot.time});
  file.attribute(root, "step", std::vector<std::int64_t>{static_cast<std::int64_t>(snapshot.step)});

  file.group(point_data);
  const std::array<std::size_t, 3> shape{static_cast<std::size_t>(n[2]), static_cast<std::size_t>(n[1]),
                                         static_cast<std::size_t>(n[0])};
  for (const GridSnapshot::Column& column : snapshot.columns)
    std::visit(
        [&](const auto& values) {
          if (values.size() != snapshot.cells())
            throw std::invalid_argument(fmt::format("snapshot: column '{}' has {} entries for {} cells", column.name,
                                                    values.size(), snapshot.cells()));
          file.write_grid(point_data + "/" + column.name, shape, values, column.unit);
        },
        column.values);
  write_atomically(path, file.image());
}

GridSnapshot read_grid(const std::filesystem::path& path) {
  const hdf5::Reader file(path);
  const auto refuse = [&](const char* what) { throw FileError(path.string(), what); };
  if (!file.has(root) || file.text_attribute(root, "Type") != "ImageData") refuse("holds no grid of cells");
  const std::vector<std::int64_t> extent = file.integer_attribute(root, "WholeExtent");
  const std::vector<double> origin = file.real_attribute(root, "Origin");
  const std::vector<double> spacing = file.real_attribute(root, "Spacing");
  if (extent.size() != 6 || origin.size() != 3 || spacing.size() != 3) refuse("lacks extent, origin or spacing");
  GridSnapshot snapshot;
  for (std::size_t a = 0; a < 3; ++a) snapshot.count[a] = static_cast<int>(extent[2 * a + 1] - extent[2 * a]) + 1;
  snapshot.spacing = {spacing[0], spacing[1], spacing[2]};
  snapshot.low = Vector3{origin[0], origin[1], origin[2]} - 0.5 * snapshot.spacing;
  for (const std::string& name : file.names(point_data)) {
    const std::string data = point_data + "/" + name;
    const hdf5::Description description = file.describe(data);
    GridSnapshot::Column column{name, file.text_attribute(data, "units"), {}};
    if (description.shape.size() == 4 && description.shape[3] == 3) {
      const std::vector<double> all = file.doubles(data);
      std::vector<Vector3> values(all.size() / 3);
      for (std::size_t c = 0; c < values.size(); ++c) values[c] = {all[3 * c], all[3 * c + 1], all[3 * c + 2]};
      column.values = std::move(values);
    } else {
      column.values = file.doubles(data);
    }
    const std::size_t entries = std::visit([](const auto& values) { return values.size(); }, column.values);
    if (entries != snapshot.cells()) refuse("has a column that does not fit its cells");
    snapshot.columns.push_back(std::move(column));
  }
  const std::vector<double> time = file.real_attribute(root, "time");
  const std::vector<std::int64_t> step = file.integer_attribute(root, "step");
  if (time.size() != 1 || step.size() != 1) refuse("holds no single time");
  snapshot.time = time[0], snapshot.step = static_cast<std::uint64_t>(step[0]);
  return snapshot;
}

}  // namespace talus
