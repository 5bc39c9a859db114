// SPDX-License-Identifier: Apache-2.0
/// Faults of triangles that are meant to be a surface, and the removal of harmless ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/vector.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus {

struct SurfaceFault {
  enum class Kind {
    not_finite,       ///< a coordinate is no number
    without_area,     ///< its corners lie on a line
    twice,            ///< the same corners as another triangle
    turned_over,      ///< its normal is on the other side than its neighbour's
    branching,        ///< more than two triangles at an edge
    open_rim,         ///< one triangle alone at an edge, where the surface is to be closed
    crossing_another  ///< the surface passes through itself
  };
  Kind kind;
  std::uint32_t triangle;              ///< number, from 0
  std::optional<std::uint32_t> other;  ///< the second triangle of the fault
  Vector3 place;                       ///< in the unit of the corners
};

/// In words: "has no area".
std::string_view text_of(SurfaceFault::Kind kind);

/// All of them, by kind, and by number within a kind. A triangle without area counts only as that. Coordinates that
/// belong together must be bitwise identical. \param closed the surface may have no rims; else it may: a vessel is open
/// at its top
std::vector<SurfaceFault> faults_of(std::span<const Triangle> triangles, bool closed = false);

// A surface as files hold it, without what is harmless but in the way: walls by integrals need no common side of the
// normals, but a triangle that is there twice would count twice, and one without area has no normal.

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
