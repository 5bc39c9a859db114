// SPDX-License-Identifier: Apache-2.0
/// What stands around the particles of a case, for a viewer.
#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/domain.hpp"

namespace talus::app {

/// A line in the x-z plane, through the whole depth.
struct WallLine {
  Vector3 from, to;                                        ///< m
  double until = std::numeric_limits<double>::infinity();  ///< a gate: when it opens, s from the gate of the case
};

struct Scene {
  std::vector<WallLine> walls;
  std::optional<std::pair<Vector3, Vector3>> box;  ///< low and high corner, m; nothing: without bounds
  bool slope = false;                              ///< the plane z = 0 is one
  double radius = 0;                               ///< of particles that have no column "radius", m
  std::string_view view = "xz";                    ///< from which the scene is seen first: xz, xy or free
};

/// The solid parts of the walls within a domain, and their gates that are shut.
std::vector<WallLine> wall_lines(const Domain& domain);

/// The same, and the floor and the sides of its box, where they are walls or planes of symmetry.
Scene scene_of(const Domain& domain, double radius);

}  // namespace talus::app
