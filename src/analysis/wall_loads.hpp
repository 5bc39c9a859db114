// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel carry, from the impulses that they received since the start: sums of the steps
/// themselves, not of pairs of particles. A wall is known by the columns of a series, "impulse_floor_x" to "_z", N s.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"
#include "numerics/series.hpp"

namespace talus {

/// The walls of a series, in the order of their columns: "left", "right", "front", "rear", "floor", "top", "plate", ...
std::vector<std::string> walls_of(const Series& series);

/// Mean force on a wall over from..to: what it received, over the time, N. nan if the series does not cover the time.
/// \param from, to in the series' own time \throws std::out_of_range if there is no such wall
Vector3 wall_force(const Series& series, std::string_view wall, double from, double to);

/// Upward force of all walls on the grains over from..to, over their weight, less 1.
double weight_balance_error(const Series& series, double weight, double from, double to);

/// Size of the difference between the change of momentum over the whole series and the impulses that made it (gravity,
/// less what walls and damping took), over the impulse of gravity's size.
/// Columns: momentum_*, impulse_gravity_*, impulse_damping_*, impulse_WALL_*.
double momentum_error(const Series& series);

}  // namespace talus
