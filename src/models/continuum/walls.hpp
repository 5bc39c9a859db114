// SPDX-License-Identifier: Apache-2.0
/// What boundaries do to the particles in a step, and what the particles do to them.
#pragma once

#include <span>

#include "base/parallel.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/sweep.hpp"

namespace talus::continuum {

/// Whether walls are rough at present.
bool has_wall_friction(const Parameters& parameters, const State& state);

/// After velocities have changed by rates over `duration`: counts the load of the walls in state.wall_impulse, and rubs
/// friction to the particles that press against them.
/// \param position where the rates were evaluated, m
void apply_wall_friction(ThreadTeam& team, const Parameters& parameters, const Domain& domain, const Rates& rates,
                         std::span<const Vector3> position, double duration, State& state);

/// Turns back the particles that have passed a boundary: each goes on as the image that has come in for it, place,
/// velocity and what the law knows mirrored. The walls receive twice the normal momentum. \param before positions at
/// the start of the step, m
void reflect_at_walls(ThreadTeam& team, const Material& material, const Domain& domain, std::span<const Vector3> before,
                      State& state);

}  // namespace talus::continuum
