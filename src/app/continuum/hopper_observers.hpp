// SPDX-License-Identifier: Apache-2.0
/// What is recorded of a hopper in every row of series.csv beside the model's own totals.
#pragma once

#include <vector>

#include "models/continuum/setup/layout.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "numerics/run_record.hpp"
#include "numerics/snapshot.hpp"

namespace talus::app {

/// Columns, all at the time of the row; x and z in m from the lower left corner, y in the middle:
///   discharged_mass  kg    mass of the particles whose centre is below the plate; without a plate 0
///   discharge_rate   kg/s  flux of mass downwards through the plate's plane, particles spread along z by the cubic
///   spline lowest_z         m     of the particles' centres mass_near_floor  kg    of the particles within a spacing
///   of the floor slit_velocity    m/s   u_z in the middle of the slit probe_density    kg/m3, probe_velocity m/s
///   (u_z), probe_stress Pa (the law's, zz), probe_strain 1 (norm of the strain
///                    that the law remembers; 0 if it remembers none): an eighth of the outlet's width above its middle
/// Values at a place are the kernel's means over the particles around it; nan where there are none.
/// Of a vessel with several outlets the columns discharge_rate_NAME besides, the flux through each at its own height,
/// of the particles no farther beside it than a spacing.
std::vector<NamedValue> observe_hopper(const Pieces& pieces, const continuum::Layout& layout);

}  // namespace talus::app
