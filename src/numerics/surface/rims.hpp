// SPDX-License-Identifier: Apache-2.0
/// Where a surface ends: the edges of one triangle alone, strung together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus {

/// A closed line along edges.
struct Rim {
  std::vector<Vector3> corners;          ///< in its order; the last one is joined to the first
  std::vector<std::uint32_t> triangles;  ///< that have the edge from each corner to the next
};

/// All closed ones, by the first of their triangles. Corners are one where they are the same numbers.
/// \param triangles finite, each with an area
std::vector<Rim> rims_of(std::span<const Triangle> triangles);

}  // namespace talus
