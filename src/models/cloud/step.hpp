// SPDX-License-Identifier: Apache-2.0
/// One time step of a cloud: dx/dt = v(x), Eq. 4b, stiff through the contacts.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/state.hpp"
#include "models/cloud/velocities.hpp"

namespace talus::cloud {

/// Workspace of a step; recomputed from the state when a run is resumed.
struct Workspace {
  Velocities velocities;
  Scales scales;
  std::vector<Vector3> latest, before, trial_velocity;
  std::vector<std::vector<Vector3>> rates;  ///< of the stages after the first, Dormand and Prince's alone

  Workspace(const Parameters& parameters, const State& state);
};

/// Completes a state that has position and radius: velocities, contacts, first step, stiffest motion.
void begin(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// Recomputes the derived columns, from kept ones, after a checkpoint was read.
void derive(ThreadTeam& team, State& state, Workspace& workspace);

/// The condition that limits the last step, and where: the stiffness of the contacts, or the error control.
NumericalError::Report step_limit(const Parameters& parameters, const State& state);

/// Advances by one step of at most integration.largest_step.
/// \throws NumericalError if velocities stop being finite or overlaps grow beyond integration.largest_overlap even at
///         the least step; the state is then that of the last good step
void advance(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

}  // namespace talus::cloud
