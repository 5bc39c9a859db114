// SPDX-License-Identifier: Apache-2.0
/// One time step of the grains: density by Eq. 16, velocity by Eq. 17, stress by the law, walls, phases.
#pragma once

#include "models/continuum/workspace.hpp"

namespace talus::continuum {

/// Completes a new state: neighbour lists, rates, derived columns.
void begin(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// Recomputes derived fields after a checkpoint was read.
void derive(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// The condition that limits the last step, and where: the Courant number of the grains, or the air.
NumericalError::Report step_limit(const Setup& setup, const State& state, const Workspace& workspace);

/// Advances by one step.
/// \throws NumericalError for a velocity or density that is not finite, or a bed that does not settle in time
void advance(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

}  // namespace talus::continuum
