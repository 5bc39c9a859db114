// SPDX-License-Identifier: Apache-2.0
/// Surfaces of triangles as VTKHDF, which ParaView opens.
#pragma once

#include <filesystem>

#include "numerics/surface_snapshot.hpp"

namespace talus {

/// Points, triangles as cells, the columns as cell data with their units, and the time as of particles'
/// (vtkhdf.hpp), so that read_points_time() reads it. \throws FileError
void write_surface(const std::filesystem::path& path, const SurfaceSnapshot& snapshot);

}  // namespace talus
