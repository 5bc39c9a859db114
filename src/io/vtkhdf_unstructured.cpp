// SPDX-License-Identifier: Apache-2.0
#include "io/vtkhdf_unstructured.hpp"

#include <vector>

namespace talus::vtkhdf {

void write_cells(hdf5::Writer& file, std::size_t points, std::uint8_t cell_type, std::span<const std::int64_t> offsets,
                 std::span<const std::int64_t> connectivity) {
  const std::size_t cells = offsets.size() - 1;
  const auto single = [](std::size_t n) { return std::vector<std::int64_t>{static_cast<std::int64_t>(n)}; };
  file.group(root);
  file.attribute(root, "Type", "UnstructuredGrid");
  file.attribute(root, "Version", std::vector<std::int64_t>{1, 0});
  file.write(root + "/NumberOfPoints", single(points));
  file.write(root + "/NumberOfCells", single(cells));
  file.write(root + "/NumberOfConnectivityIds", single(connectivity.size()));
  file.write(root + "/Offsets", offsets);
  file.write(root + "/Connectivity", connectivity);
  file.write(root + "/Types", std::vector<std::uint8_t>(cells, cell_type));
}

void write_time(hdf5::Writer& file, double time, std::uint64_t step) {
  file.write(root + "/FieldData/time", std::vector<double>{time}, "s");
  file.write(root + "/FieldData/TimeValue", std::vector<double>{time}, "s");
  file.write(root + "/FieldData/step", std::vector<std::int64_t>{static_cast<std::int64_t>(step)}, "1");
}

}  // namespace talus::vtkhdf
