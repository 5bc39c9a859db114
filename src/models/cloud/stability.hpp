// SPDX-License-Identifier: Apache-2.0
/// Stability limits of the step of a cloud, from its parameters alone.
#pragma once

#include "models/cloud/parameters.hpp"

namespace talus::cloud {

/// Of the stability polynomial: stiff modes decay by at least 10 % per step.
inline constexpr double stage_damping = 0.1;

/// Rate at which contacts that form within a step relax, 1/s: a floor for the estimate, since the power iteration sees
/// only the contacts of the start. In units of k_n/(6 pi mu a_p): 1.5 with drag between the grains (the relative
/// mobility of touching grains is small), 6 without (a triangular lattice of springs).
double contact_rate(const Parameters& parameters);

/// The longest step with which a rate is stable, s: of as many stages as Chebyshev's may be, of Dormand and Prince's,
/// or of the one of explicit Euler. \param rate 1/s, > 0
double longest_stable_step(const Parameters& parameters, double rate);

}  // namespace talus::cloud
