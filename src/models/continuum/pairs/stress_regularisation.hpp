// SPDX-License-Identifier: Apache-2.0
/// Deviators that differ from particle to particle. In a heap they end near yield in directions that have nothing to do
/// with each other, and most of their mean is lost (docs/design/stabilisation.md). The deviatoric increment of a step
/// is therefore blended with the kernel average of the neighbours:
///
///     s_i <- s_i + w (p_i S_i/P_i - s_i),   w = q/(1 + q),   q = K G gamma' dt/p_i,   gamma' = (2 D':D')^(1/2)
///
/// with S and P deviator and mean of sum_j W_ij tau_j/rho_j^2, the particle itself among them, tau the whole stress of
/// Eq. 7, s_i and p_i deviator and mean of the law's own, and G its shear modulus. K = 1 takes as much from around as
/// the strain makes; range: 0.1 to 1 were tried, and 0.2 is nearest to beads.
/// A uniform ratio s/p stays as it is under any pressures; where nothing moves nothing changes; grains apart have and
/// give nothing. Where grains stick together p + a, a their tensile strength, takes the place of p. Source: the stress
/// regularisation of Nguyen, Nguyen, Bui, Nguyen & Fukagawa, Landslides 14, 69 (2017), who set the stress to the mean
/// of the neighbours every few steps; completed: of the ratio, and by the strain.
#pragma once

#include "base/parallel.hpp"
#include "models/continuum/pairs/pair_sums.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"

namespace talus::continuum {

/// Draws the deviators of the state, of a particle that bears pressure. \param dt s; \param rates velocity gradients of
/// the step, and stresses around the particles of the last sum over forces
/// \pre stress_regularisation(parameters) > 0
void regularise_stress(ThreadTeam& team, const Parameters& parameters, double dt, const Rates& rates, State& state);

}  // namespace talus::continuum
