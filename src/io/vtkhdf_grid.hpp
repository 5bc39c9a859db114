// SPDX-License-Identifier: Apache-2.0
/// Values in the cells of a regular grid as VTKHDF 1.0, one file per frame: what ParaView 5.11, VTK 9.1 and h5py read.
///
///     /VTKHDF                Type "ImageData", Version [1, 0]; WholeExtent, Origin, Spacing, Direction; time (s),
///     step;
///                            cells (along x, y, z)
///       PointData/NAME       columns in single precision: nz x ny x nx, or nz x ny x nx x 3, of the points
///
/// The points of the image are the centres of the cells: VTK 9.1 asks data of an image's cells, and its field data, for
/// the wrong shape. Nor does it survive an image that is one point deep: along an axis of one cell the points are its
/// two faces, with the cell's value at both, so that a section is shown as the slab that it is. Every column carries
/// its unit in the attribute "units".
/// Source: VTK File Formats, "VTKHDF file format", https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/
#pragma once

#include <filesystem>

#include "numerics/grid_snapshot.hpp"

namespace talus {

/// Writes a grid, whole or not at all. The same grid gives the same bytes.
/// \throws FileError with the system's reason
/// \throws std::invalid_argument if a column does not have an entry per cell (a fault of the model)
void write_grid(const std::filesystem::path& path, const GridSnapshot& snapshot);

/// Reads what write_grid() wrote. \throws FileError if the file cannot be read or holds something else
GridSnapshot read_grid(const std::filesystem::path& path);

}  // namespace talus
