// SPDX-License-Identifier: Apache-2.0
/// Contact of particles with the walls of a vessel, friction, the loads of the walls, and the return of particles that
/// would pass them.
#pragma once

#include <span>

#include "base/parallel.hpp"
#include "models/continuum/boundary/walls.hpp"
#include "models/continuum/pairs/pair_sums.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"
#include "numerics/surface/surface.hpp"
#include "numerics/surface/surface_fields.hpp"

namespace talus::continuum {

/// As apply_wall_contact (walls.hpp), for the vessel: adds its loads to state.vessel_impulse. The loads go to
/// state.wall_loads too, each to a field of the wall: that of stress to the one nearest to the particle when the
/// neighbour lists were built, that of contact to the one it touches. \param fields of the vessel
void apply_vessel_contact(ThreadTeam& team, const Parameters& parameters, const SurfaceFields& fields,
                          const Rates& rates, const ContactStep& step, PairSums& pairs, State& state);

/// As hold_off_walls (walls.hpp), for the vessel.
void hold_off_vessel(ThreadTeam& team, const Rates& rates, std::span<const Vector3> position, const ContactStep& step,
                     PairSums& pairs, std::span<Vector3> velocity);

/// Particles that have crossed a triangle come back: as far before it as they were behind it, without their velocity
/// towards it, with friction. None is left behind a wall.
/// \param neighbourhood of the particles, whose lists were built before the step; \param before positions at the start
/// of the step, m
void reflect_at_vessel(ThreadTeam& team, const Parameters& parameters, const Surface& vessel,
                       const Neighbourhood& neighbourhood, const SurfaceFields& fields, std::span<const Vector3> before,
                       State& state);

}  // namespace talus::continuum
