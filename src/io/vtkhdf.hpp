// SPDX-License-Identifier: Apache-2.0
/// Particles, grids and surfaces as VTKHDF 1.0, one file per frame: what ParaView 5.11, VTK 9.1 and h5py read. ParaView
/// finds the reader by the index of snapshots (run_json.hpp).
///
///     /VTKHDF               Type "UnstructuredGrid", Version [1, 0]; every particle is a point and a vertex cell
///       Points  n x 3       the column "position"
///       PointData/NAME      every other column: n or n x 3 doubles, or n 64-bit integers
///       FieldData/time, step, TimeValue
///       FieldData/sector_copies, sector_axis (1 x 3), sector_identities
///                           of a sector, which stands in the file once: SectorCopies
///
/// Every data set with a unit carries it in the attribute "units".
/// Source: VTK File Formats, "VTKHDF file format", https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/
#pragma once

#include <filesystem>
#include <string>

#include "numerics/snapshot.hpp"

namespace talus {

/// The group of a file that its readers look for.
inline const std::string vtkhdf_root = "VTKHDF";

/// Writes a snapshot, whole or not at all. The same snapshot gives the same bytes.
/// \throws FileError with the system's reason
/// \throws std::invalid_argument if columns differ in length (a fault of the model)
void write_points(const std::filesystem::path& path, const PointSource& points);
inline void write_points(const std::filesystem::path& path, const Snapshot& snapshot) {
  write_points(path, source_of(snapshot));
}

/// Reads an unstructured grid or poly data of one time, ours or another program's: points and data of points; cells are
/// passed over. Reals of any width become doubles, integers 64 bits; columns of k components other than 3 become
/// k columns NAME_0 ... A missing unit is "1"; positions are taken as metres. Time and step are 0 where not given. Of a
/// sector the particles of all copies (whole_of(), numerics/snapshot.hpp); a file without sector_copies holds the
/// whole. \throws FileError if the file cannot be read or is damaged \throws InputError if it is no such file: all that
/// is wrong with it
PointSet read_points(const std::filesystem::path& path);

/// How many times as many particles read_points() returns as the file of particles holds: the copies of a sector,
/// else 1. \throws FileError
int read_copies(const std::filesystem::path& path);

/// The time of one of our files, of points or of a grid, s. \throws FileError
double read_points_time(const std::filesystem::path& path);

/// A surface: points, triangles as cells, the columns as cell data with their units, and the time as of particles,
/// so that read_points_time() reads it. \throws FileError
void write_surface(const std::filesystem::path& path, const SurfaceSnapshot& snapshot);

// Values in the cells of a regular grid:
//
//     /VTKHDF          Type "ImageData", Version [1, 0]; WholeExtent, Origin, Spacing, Direction; time (s), step;
//                      cells (along x, y, z)
//       PointData/NAME columns in single precision: nz x ny x nx, or nz x ny x nx x 3, of the points
//
// The points of the image are the centres of the cells: VTK 9.1 asks data of an image's cells, and its field data, for
// the wrong shape. Nor does it survive an image that is one point deep: along an axis of one cell the points are its
// two faces, with the cell's value at both, so that a section is shown as the slab that it is. Every column carries
// its unit in the attribute "units".

/// Writes a grid, whole or not at all. The same grid gives the same bytes.
/// \throws FileError with the system's reason
/// \throws std::invalid_argument if a column does not have an entry per cell (a fault of the model)
void write_grid(const std::filesystem::path& path, const GridSnapshot& snapshot);

/// Reads what write_grid() wrote. \throws FileError if the file cannot be read or holds something else
GridSnapshot read_grid(const std::filesystem::path& path);

}  // namespace talus
