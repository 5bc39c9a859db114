// SPDX-License-Identifier: Apache-2.0
/// The check of a state after a step.
#pragma once

#include "base/parallel.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"
#include "numerics/geometry/domain.hpp"

namespace talus::continuum {

/// \param dt length of the step that led here, s
/// \throws NumericalError for a density or velocity that is not finite, or that no step of this length can have made
void check_state(ThreadTeam& team, const Parameters& parameters, const Domain& domain, const State& state, double dt);

}  // namespace talus::continuum
