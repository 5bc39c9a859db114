// SPDX-License-Identifier: Apache-2.0
/// What the unstructured grids of particles and of surfaces have in common, as VTKHDF 1.0 has it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/hdf5.hpp"

namespace talus::vtkhdf {

inline const std::string root = "VTKHDF";

/// Type, version and cells, all of one kind. \param cell_type of vtkCellType.h \param offsets where the points of each
/// cell begin in `connectivity`, and where the last ends
void write_cells(hdf5::Writer& file, std::size_t points, std::uint8_t cell_type, std::span<const std::int64_t> offsets,
                 std::span<const std::int64_t> connectivity);

/// The field data time, TimeValue and step. \param time s
void write_time(hdf5::Writer& file, double time, std::uint64_t step);

}  // namespace talus::vtkhdf
