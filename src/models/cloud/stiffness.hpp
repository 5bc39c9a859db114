// SPDX-License-Identifier: Apache-2.0
/// The stiffest rate of a cloud, which fixes the number of Chebyshev stages.
#pragma once

#include "base/parallel.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/state.hpp"
#include "models/cloud/step.hpp"

namespace talus::cloud {

/// Power iteration with the velocities themselves: the largest |lambda| of dv/dx, from state.stiff_mode, which it
/// improves. Updates state.spectral_radius and counts its evaluations.
/// \param sweeps at most so many evaluations; fewer once the estimate changes by less than 2 %
void estimate_stiffness(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace, int sweeps);

}  // namespace talus::cloud
