// SPDX-License-Identifier: Apache-2.0
/// The air in a hopper and a bin at one time, from the cells of its grid, as Yuu & Umekage (2011) look at it: sections
/// 5.1 and 5.2. Estimators: validation/yuu2011/reference.toml.
#pragma once

#include "analysis/hopper.hpp"
#include "numerics/grid_snapshot.hpp"

namespace talus {

/// Fills the frame's numbers of the air, those of a slit where the shape has one.
/// \param air with the columns velocity, pressure, solid_fraction, grain_velocity, drag
void measure_air(HopperFrame& frame, const GridSnapshot& air, const HopperSetting& setting);

/// Integral of the curl du_x/dz - du_z/dx of the air's velocity over the cells of its middle layer whose centres lie
/// within the rectangle and which hold hardly any grains, m^2/s: central differences within the rectangle, one-sided at
/// its rim. Positive: up on the left, to the right above.
double circulation(const GridSnapshot& air, double left, double right, double bottom, double top);

}  // namespace talus
