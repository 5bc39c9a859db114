// SPDX-License-Identifier: Apache-2.0
#include "io/vtkhdf_surface.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/hdf5.hpp"

namespace talus {

namespace {

constexpr std::uint8_t vtk_triangle = 5;  // vtkCellType.h
const std::string root = "VTKHDF";

}  // namespace

// As an unstructured grid: VTK 9.1 and ParaView 5.11 read no PolyData.
void write_surface(const std::filesystem::path& path, const SurfaceSnapshot& snapshot) {
  hdf5::Writer file(path);
  file.group(root);
  file.attribute(root, "Type", "UnstructuredGrid");
  file.attribute(root, "Version", std::vector<std::int64_t>{1, 0});
  std::vector<std::int64_t> offsets{0}, connectivity;
  for (const auto& corners : snapshot.triangles) {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  const auto single = [](std::size_t n) { return std::vector<std::int64_t>{static_cast<std::int64_t>(n)}; };
  file.write(root + "/NumberOfPoints", single(snapshot.points.size()));
  file.write(root + "/NumberOfCells", single(snapshot.triangles.size()));
  file.write(root + "/NumberOfConnectivityIds", single(connectivity.size()));
  file.write(root + "/Offsets", offsets);
  file.write(root + "/Connectivity", connectivity);
  file.write(root + "/Types", std::vector<std::uint8_t>(snapshot.triangles.size(), vtk_triangle));
  file.write(root + "/Points", snapshot.points, "m");
  file.group(root + "/CellData");
  for (const GridSnapshot::Column& column : snapshot.columns)
    std::visit(
        [&](const auto& values) {
          if (values.size() != snapshot.triangles.size())
            throw std::invalid_argument(fmt::format("snapshot: column '{}' has {} entries for {} triangles",
                                                    column.name, values.size(), snapshot.triangles.size()));
          file.write(root + "/CellData/" + column.name, std::span(values), column.unit);
        },
        column.values);
  file.write(root + "/FieldData/time", std::vector<double>{snapshot.time}, "s");
  file.write(root + "/FieldData/TimeValue", std::vector<double>{snapshot.time}, "s");
  file.write(root + "/FieldData/step", std::vector<std::int64_t>{static_cast<std::int64_t>(snapshot.step)}, "1");
  write_atomically(path, file.image());
}

}  // namespace talus
