// SPDX-License-Identifier: Apache-2.0
/// One time step of the grains: density by Eq. 16, velocity by Eq. 17, stress by the law, walls; and the phases of a
/// run: the bed settles, the gate opens, the grains flow.
#pragma once

#include <optional>

#include "models/continuum/workspace.hpp"

namespace talus::continuum {

/// Completes a new state: neighbour lists, rates, derived columns.
void begin(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// Recomputes derived fields after a checkpoint was read.
void derive(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// What limits the step, of all particles. \param vote of this process besides, which is false if that of any is
GrainLimits joined_limits(ThreadTeam& team, const State& state, const Workspace& workspace, bool& vote);

/// The time step, decided only here, s: the limit of the grains; at the start of a step of the air also the limit of
/// the air; until the end of that step unchanged.
double step_length(ThreadTeam& team, const Setup& setup, const State& state, Workspace& workspace);

/// The condition that limits the last step, and where: the Courant number of the grains, or the air.
/// Together, of several processes.
NumericalError::Report step_limit(const Setup& setup, const State& state, const Workspace& workspace);

/// Advances by one step.
/// \throws NumericalError for a velocity or density that is not finite, or a bed that does not settle in time
void advance(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// The first particle of this process whose density or velocity is not finite, or none that a step of this length can
/// have made; nothing if there is none. \param dt length of the step that led here, s
std::optional<std::size_t> find_fault(ThreadTeam& team, const Parameters& parameters, const Domain& domain,
                                      const Share& share, const State& state, double dt);
/// What is wrong with it.
NumericalError::Report report_of(const Parameters& parameters, const Domain& domain, const State& state, double dt,
                                 std::size_t particle);

/// How many particles of this process are faster than a bed at rest.
std::uint64_t count_moving(ThreadTeam& team, const Setup& setup, const Share& share, const State& state);

/// The densities begin as the kernel's sums with the bed's smoothing length, though nowhere above the bed's: beside a
/// wall at an angle the images are not a lattice, and the sum is some per cent off.
void begin_densities(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// Finds out whether the bed is at rest, and opens the gates whose time has come. \param moving how many are (of all)
/// \throws NumericalError for a bed that does not settle in time
void update_phase(ThreadTeam& team, const Setup& setup, std::uint64_t moving, State& state, Workspace& workspace);

}  // namespace talus::continuum
