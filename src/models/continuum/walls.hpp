// SPDX-License-Identifier: Apache-2.0
/// Wall friction and reflection of particles in a step, and the loads of the walls.
#pragma once

#include <span>

#include "base/parallel.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/sweep.hpp"

namespace talus::continuum {

/// Whether walls have friction at present.
bool has_wall_friction(const Parameters& parameters, const State& state);

/// After velocities have changed by rates over `duration`: adds the loads of the walls to state.wall_impulse, and
/// applies friction to the particles that press against them.
/// \param position where the rates were evaluated, m
void apply_wall_friction(ThreadTeam& team, const Parameters& parameters, const Domain& domain, const Rates& rates,
                         std::span<const Vector3> position, double duration, State& state);

/// Reflects the particles that have crossed a boundary: position, velocity and history of the law are mirrored. The
/// walls receive twice the normal momentum. \param before positions at the start of the step, m
void reflect_at_walls(ThreadTeam& team, const Material& material, const Domain& domain, std::span<const Vector3> before,
                      State& state);

}  // namespace talus::continuum
