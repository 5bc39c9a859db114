// SPDX-License-Identifier: Apache-2.0
/// The lines in which a surface meets an upright plane: what is drawn of a vessel.
#pragma once

#include <array>
#include <vector>

#include "numerics/surface/surface.hpp"

namespace talus {

/// Where the surface meets the plane at that y, open patches left out. \param y m
std::vector<std::array<Vector3, 2>> section_at(const Surface& surface, double y);

}  // namespace talus
