// SPDX-License-Identifier: Apache-2.0
/// What can be wrong with triangles that are meant to be a surface.
#pragma once

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
    turned_over,      ///< its normal is on the other side than that of its neighbour
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

}  // namespace talus
