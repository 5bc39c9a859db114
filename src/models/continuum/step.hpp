// SPDX-License-Identifier: Apache-2.0
/// One time step of the grains: density by Eq. 16, velocity by Eq. 17, stress by the law, walls; and the phases of a
/// run: the bed settles, the gate opens, the grains flow.
#pragma once

#include "models/continuum/workspace.hpp"

namespace talus::continuum {

/// Completes a new state: neighbour lists, rates, derived columns.
void begin(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// Recomputes derived fields after a checkpoint was read.
void derive(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// The condition that limits the last step, and where: the Courant number of the grains, or the air.
/// \param state of all particles \param smoothing_length of these, m
NumericalError::Report step_limit(const Setup& setup, const State& state, std::span<const double> smoothing_length,
                                  const Workspace& workspace);

/// Advances by one step.
/// \throws NumericalError for a velocity or density that is not finite, or a bed that does not settle in time
void advance(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// \param dt length of the step that led here, s
/// \throws NumericalError for a density or velocity that is not finite, or that no step of this length can have made;
/// of several processes each throws the same
void check_state(ThreadTeam& team, const Parameters& parameters, const Domain& domain, const Share& share,
                 const State& state, double dt);

/// The densities begin as the kernel's sums with the bed's smoothing length, though nowhere above the bed's: beside a
/// wall at an angle the images are not a lattice, and the sum is some per cent off.
void begin_densities(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// Finds out whether the bed is at rest, and opens the gates whose time has come.
/// \throws NumericalError for a bed that does not settle in time
void update_phase(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

}  // namespace talus::continuum
