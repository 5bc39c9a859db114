// SPDX-License-Identifier: Apache-2.0
/// Particles as a table of comma-separated values: a header line that names the columns, then one line per particle.
///
///     x [mm],y [mm],z [mm],radius [um],velocity_x [m/s],velocity_y [m/s],velocity_z [m/s],mass [g]
///     1.5,0,2,200,0,0,-0.1,3.2e-5
///
/// Coordinates, radii and diameters without a unit are metres, other columns numbers. A column r is the radius, a
/// column diameter twice the radius. Blank lines, blanks around entries, a byte order mark and line ends of either kind
/// are taken.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv_table.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// Reads particles: "position" from x, y and z (y and z may be missing and are then 0), vectors from three columns
/// NAME_x, NAME_y, NAME_z, and a scalar from every other column; all converted to SI, angles to radians, each to the
/// double nearest to what is written.
/// \param required columns required in addition to x, such as "radius"
/// \throws FileError if the file cannot be read
/// \throws InputError with every bad line, or the first 20 and their count: entries that are missing, no numbers, not
///         finite or too large, and columns that are missing, given twice or in an unknown unit
PointSet read_points_csv(const std::filesystem::path& path, std::span<const std::string_view> required = {});

struct GivenPoints {
  PointSet points;
  std::vector<std::string> without_unit;  ///< of position and radius, the columns whose header gives no unit
};

/// The same of a file whose columns all have a use: any but x, y, z, radius and those of `others` is a problem,
/// reported with its reason if it is one of `refused`.
GivenPoints read_given_points(const std::filesystem::path& path, std::span<const KnownColumn> others,
                              std::span<const RefusedColumn> refused = {});

}  // namespace talus
