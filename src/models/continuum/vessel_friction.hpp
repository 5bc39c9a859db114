// SPDX-License-Identifier: Apache-2.0
/// Friction at the walls of a vessel, their loads, and the reflection of particles that would pass them.
#pragma once

#include <span>

#include "base/parallel.hpp"
#include "models/continuum/parameters.hpp"
#include "models/continuum/state.hpp"
#include "models/continuum/sweep.hpp"
#include "numerics/surface/surface.hpp"
#include "numerics/surface/surface_fields.hpp"

namespace talus::continuum {

/// As apply_wall_friction (walls.hpp), for the vessel: adds its loads to state.vessel_impulse, and applies Coulomb's
/// friction to the particles that press against it. The loads go to state.wall_loads too, each to the field of the wall
/// that was nearest to the particle when the neighbour lists were built.
/// \param fields of the vessel \param duration over which velocities have changed by the rates, s
void apply_vessel_friction(ThreadTeam& team, const Parameters& parameters, const SurfaceFields& fields,
                           const Rates& rates, double duration, State& state);

/// Particles that have crossed a triangle come back: they stand as far before it as they were behind it, and have no
/// velocity towards it any more, as grains that strike a wall. None is left behind a wall.
/// \param neighbourhood of the particles, whose lists were built before the step; \param before positions at the start
/// of the step, m
void reflect_at_vessel(ThreadTeam& team, const Surface& vessel, const Neighbourhood& neighbourhood,
                       const SurfaceFields& fields, std::span<const Vector3> before, State& state);

}  // namespace talus::continuum
