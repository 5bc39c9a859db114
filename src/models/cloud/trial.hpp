// SPDX-License-Identifier: Apache-2.0
/// A trial step of the cloud: taken in the workspace; of the state it changes counters alone.
#pragma once

#include "models/cloud/step.hpp"

namespace talus::cloud {

inline constexpr double farthest_move = 1e4;  // of a grain in a step, in mean radii: the error control refuses less

/// What it left in the workspace, and whether it may stand.
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

}  // namespace talus::cloud
