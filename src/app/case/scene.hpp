// SPDX-License-Identifier: Apache-2.0
/// For a viewer: what surrounds the particles of a case, and the numbers by which they can be coloured.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/snapshot.hpp"

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

/// Calls visit(name, unit, value), where value(n) is the number of particle n: for every column of numbers under its
/// name; for every vector its size under the column's name (not of the position) and its components, NAME_x; and of a
/// stress the pressure, a third of the trace. The identity is no such number.
template <class Visit>
void for_each_number(const Snapshot& snapshot, const Visit& visit) {
  for (const ColumnView& column : snapshot.columns) {
    const std::string name(column.name), unit(column.unit);
    if (name == "identity") continue;
    if (const auto* scalars = std::get_if<std::span<const double>>(&column.values))
      visit(name, unit, [&](std::size_t n) { return (*scalars)[n]; });
    if (const auto* integers = std::get_if<std::span<const std::int64_t>>(&column.values))
      visit(name, unit, [&](std::size_t n) { return static_cast<double>((*integers)[n]); });
    if (const auto* vectors = std::get_if<std::span<const Vector3>>(&column.values)) {
      if (name != "position") visit(name, unit, [&](std::size_t n) { return norm((*vectors)[n]); });
      for (int axis = 0; axis < 3; ++axis)
        visit(name + '_' + "xyz"[axis], unit, [&](std::size_t n) { return (*vectors)[n][axis]; });
    }
  }
  if (snapshot.has("stress_xx") && snapshot.has("stress_yy") && snapshot.has("stress_zz")) {
    const auto x = snapshot.scalars("stress_xx"), y = snapshot.scalars("stress_yy"), z = snapshot.scalars("stress_zz");
    visit("pressure", "Pa", [&](std::size_t n) { return (x[n] + y[n] + z[n]) / 3; });
  }
}

}  // namespace talus::app
