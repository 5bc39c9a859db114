// SPDX-License-Identifier: Apache-2.0
#include "io/vtkhdf_surface.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/hdf5.hpp"
#include "io/vtkhdf_unstructured.hpp"

namespace talus {

namespace {

using vtkhdf::root;

constexpr std::uint8_t vtk_triangle = 5;  // vtkCellType.h

}  // namespace

// As an unstructured grid: VTK 9.1 and ParaView 5.11 read no PolyData.
void write_surface(const std::filesystem::path& path, const SurfaceSnapshot& snapshot) {
  hdf5::Writer file(path);
  std::vector<std::int64_t> offsets{0}, connectivity;
  for (const auto& corners : snapshot.triangles) {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  vtkhdf::write_cells(file, snapshot.points.size(), vtk_triangle, offsets, connectivity);
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
  vtkhdf::write_time(file, snapshot.time, snapshot.step);
  write_atomically(path, file.image());
}

}  // namespace talus
