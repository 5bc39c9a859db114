// SPDX-License-Identifier: Apache-2.0
/// Particles of bed.file.
#pragma once

#include <filesystem>

#include "models/continuum/setup/bed.hpp"

namespace talus::app {

/// Reads particles from CSV (io/csv_table.hpp) with the columns x, y, z and, where they are known, velocity_x,
/// velocity_y, velocity_z and density (bulk density); or from VTKHDF (io/vtkhdf.hpp), whose other columns are passed
/// over and named.
/// \throws FileError if the file cannot be read
/// \throws InputError with every bad line or column
continuum::GivenBed read_bed(const std::filesystem::path& path);

}  // namespace talus::app
