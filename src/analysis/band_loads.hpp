// SPDX-License-Identifier: Apache-2.0
/// The load of a part of a wall, from the impulses that it received: the columns "normal_impulse_NAME" and
/// "shear_impulse_NAME" of a series (models/continuum/boundary/vessel_loads.hpp).
#pragma once

#include <string>
#include <vector>

#include "analysis/curve.hpp"
#include "numerics/series.hpp"

namespace talus {

/// Where a band is.
struct BandOfWall {
  std::string name;                    ///< in the columns
  std::size_t patch = 0;               ///< from 0
  double low = 0, high = 0, area = 0;  ///< m, m^2
  double sine = 0;                     ///< of the wall's angle with the vertical: 0 upright, 1 level

  bool is_upright() const { return sine < 1e-3; }
};

/// Stresses on a band, Pa: across it, and along it downwards (nan on a level one).
struct BandLoad {
  double pressure_at_rest = 0, shear_at_rest = 0;  ///< over T before the gate opened; nan without that
  double pressure_in_flow = 0, shear_in_flow = 0;  ///< over the window
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
