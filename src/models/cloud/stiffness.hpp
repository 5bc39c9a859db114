// SPDX-License-Identifier: Apache-2.0
/// The stiffest rate of a cloud, which fixes the number of Chebyshev stages.
#pragma once

#include "base/parallel.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/state.hpp"
#include "models/cloud/step.hpp"

namespace talus::cloud {

/// Rate at which contacts that form within a step relax, 1/s: a floor for the estimate, since the power iteration sees
/// only the contacts of the start. In units of k_n/(6 pi mu a_p): 1.5 with drag between the grains (the relative
/// mobility of touching grains is small), 6 without (a triangular lattice of springs).
double contact_rate(const Parameters& parameters);

inline constexpr double stage_damping =
    0.1;  ///< of the stability polynomial: stiff modes shrink by 10 % a step at least

/// The longest step with which a rate is stable, s: of as many stages as there may be, or of one with explicit Euler.
/// \param rate 1/s, > 0
double longest_stable_step(const Parameters& parameters, double rate);

/// Power iteration with the velocities themselves: the largest |lambda| of dv/dx, from state.stiff_mode, which it
/// improves. Updates state.spectral_radius and counts its evaluations.
/// \param sweeps at most so many evaluations; fewer once the estimate changes by less than 2 %
void estimate_stiffness(ThreadTeam& team, const Parameters& parameters, State& state, Workspace& workspace, int sweeps);

}  // namespace talus::cloud
