// SPDX-License-Identifier: Apache-2.0
/// One time step of a cloud: dx/dt = v(x), Eq. 4b, stiff through the contacts.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/state.hpp"
#include "models/cloud/velocities.hpp"
#include "ranks/ranks.hpp"

namespace talus::cloud {

/// Workspace of a step; recomputed from the state when a run is resumed.
struct Workspace {
  Velocities velocities;
  Scales scales;
  std::vector<Vector3> latest, before, trial_velocity;
  std::vector<std::vector<Vector3>> rates;  ///< of the stages after the first, Dormand and Prince's alone

  /// \param ranks as Velocities has them; what is called with a workspace is called together
  Workspace(const Parameters& parameters, const State& state, const Ranks& ranks = one_process());
};

/// Completes a state that has position and radius: velocities, contacts, first step, stiffest motion.
void begin(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

/// Recomputes the derived columns, from kept ones, after a checkpoint was read.
void derive(ThreadTeam& team, State& state, Workspace& workspace);

/// The condition that limits the last step, and where: the stiffness of the contacts, or the error control.
NumericalError::Report step_limit(const Parameters& parameters, const State& state);

/// Advances by one step of at most integration.max_step.
/// \throws NumericalError if velocities stop being finite or overlaps grow beyond integration.max_overlap even at
///         the least step; the state is then as after the last good step
void advance(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace);

inline constexpr double max_move = 1e4;  // of a grain in a step, in mean radii: the error control refuses less

/// What a trial step left in the workspace (of the state it changes counters alone), and whether it may stand.
struct Trial {
  bool finite = false;
  std::uint64_t stages = 0;
  double error = 0;    ///< root mean square of the local error, m
  double overlap = 0;  ///< largest, m
  int order = 2;       ///< the local error goes as the step to this power
};

/// Stages of the method, and the velocities at their end. \param rate of the stiffest motion, 1/s
Trial try_step(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace, double step,
               double rate);

bool all_finite(ThreadTeam& team, std::span<const Vector3> v);

/// Power iteration with the velocities themselves: the largest |lambda| of dv/dx, from state.stiff_mode, which it
/// improves. Updates state.spectral_radius and counts its evaluations.
/// \param sweeps at most so many evaluations; fewer once the estimate changes by less than 2 %
void estimate_stiffness(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace, int sweeps);

}  // namespace talus::cloud
