// SPDX-License-Identifier: Apache-2.0
/// Walls of a vessel at the faces of the box: what lies behind these.
#pragma once

#include <vector>

#include "numerics/geometry/box.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus::continuum {

/// The triangles, cut at upright mirror and periodic faces, with images of patches that end there: a particle beside
/// such a face, whose neighbours have images behind it, is held by a whole wall. A patch ends at a face if, once cut,
/// an edge lies in it. At periodic faces a patch that goes on by `reach` beyond both stays as it is. \param reach how
/// far behind a face walls are needed, m
std::vector<Triangle> with_walls_beyond_faces(std::vector<Triangle> triangles, const Box& box, double reach);

}  // namespace talus::continuum
