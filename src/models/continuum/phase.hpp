// SPDX-License-Identifier: Apache-2.0
/// The phases of a run: the bed settles, the gate opens, the grains flow.
#pragma once

#include "models/continuum/workspace.hpp"

namespace talus::continuum {

/// The densities begin as the kernel's sums with the bed's smoothing length, though nowhere above the bed's: beside a
/// wall at an angle the images are not a lattice, and the sum is some per cent off.
void begin_densities(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// Finds out whether the bed is at rest, and opens the gates whose time has come.
/// \throws NumericalError for a bed that does not settle in time
void update_phase(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

}  // namespace talus::continuum
