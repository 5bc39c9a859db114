// SPDX-License-Identifier: Apache-2.0
/// Walls of a vessel that end at a face of the box: what lies behind it.
#pragma once

#include <vector>

#include "numerics/geometry/box.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus::continuum {

/// The triangles, without those that lie behind a plane of symmetry as a whole, and with images of patches that end at
/// a mirror or a periodic face: a particle beside it, whose neighbours have images there, is held by a whole wall. A
/// patch ends at a face if an edge lies in it and no part beyond it; at periodic faces if it is beyond neither of the
/// two.
/// \param reach how far behind a face walls are needed, m
std::vector<Triangle> with_walls_beyond_faces(std::vector<Triangle> triangles, const Box& box, double reach);

}  // namespace talus::continuum
