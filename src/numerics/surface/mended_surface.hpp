// SPDX-License-Identifier: Apache-2.0
/// A surface as files hold it, without what is harmless but in the way: walls by integrals need no common side of the
/// normals, but a triangle that is there twice would count twice, and one without area has no normal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "numerics/surface/surface_faults.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus {

struct MendedSurface {
  std::vector<Triangle> triangles;       ///< in their order, all finite and with an area
  std::vector<std::uint32_t> flat;       ///< left out: without area, or not finite; numbers in the given list, rising
  std::vector<std::uint32_t> twice;      ///< left out: a former triangle has the same corners
  std::vector<std::uint32_t> turned;     ///< turned over: their neighbours have the normals on the other side
  std::vector<Vector3> branching;        ///< middles of the edges at which more than two of the triangles meet
  std::vector<Vector3> without_outside;  ///< of those across which the normals cannot agree: it has one side only
};

/// Normals spread from triangle to triangle over the edges of two; of each piece of the surface that hangs together the
/// fewer triangles are turned. \param faults those of the triangles, as faults_of() finds them
MendedSurface mended(std::span<const Triangle> triangles, std::span<const SurfaceFault> faults);

}  // namespace talus
