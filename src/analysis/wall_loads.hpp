// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel carry, from the impulses that they received since the start: sums of the steps
/// themselves, not of pairs of particles. A wall is known by the columns of a series "impulse_floor_x" to "_z", N s; a
/// part of one by "normal_impulse_NAME" and "shear_impulse_NAME" (models/continuum/boundary/vessel_loads.hpp).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/curve.hpp"
#include "base/vector.hpp"
#include "numerics/geometry/gate_times.hpp"
#include "numerics/run_record.hpp"

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

/// Where a band is.
struct BandOfWall {
  std::string name;                    ///< in the columns
  std::size_t patch = 0;               ///< from 0
  double low = 0, high = 0, area = 0;  ///< m, m^2
  double sine = 0;                     ///< of the wall's angle with the vertical: 0 upright, 1 level
  bool is_bare = false;                ///< no grain has touched it
  std::optional<GateTimes> gate = {};  ///< of one that is taken away

  bool is_upright() const { return sine < 1e-3; }
};

/// Stresses on a band, Pa: across it, and along it downwards (nan on a level one).
struct BandLoad {
  double pressure_at_rest = 0, shear_at_rest = 0;  ///< over T before the gate opened; nan without that
  double pressure_in_flow = 0, shear_in_flow = 0;  ///< over the window, of a gate while it is there; nan: it never is
  double pressure_largest = 0;                     ///< largest mean over T/2 since the gate opened, one every T/20
  double time_of_largest = 0;                      ///< its middle, from the opening, s
};

/// \param gate_time in the series' time, s \param from, to the window of the flow, from the opening, s
/// \param averaging_time T, s
BandLoad load_of(const Series& series, const BandOfWall& band, double gate_time, double from, double to,
                 double averaging_time);

/// Pressure and shear of the band against time, means over T/2 one every T/4, the time from the gate's opening.
struct BandCurves {
  Curve pressure, shear;  ///< shear without points on a level one
};
BandCurves curves_of(const Series& series, const BandOfWall& band, double gate_time, double averaging_time);

}  // namespace talus
