// SPDX-License-Identifier: Apache-2.0
/// Contact of particles with the boundary: unilateral contact and friction at every wall, whichever way it acts
/// (boundary.hpp), the loads that walls receive, and the return of particles that crossed one.
#pragma once

#include <span>

#include "base/parallel.hpp"
#include "models/continuum/boundary/boundary.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/pairs/pair_sums.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/share.hpp"
#include "models/continuum/state.hpp"
#include "numerics/surface/surface_fields.hpp"

namespace talus::continuum {

/// What contact needs to know besides the state. Loads go to state.patch_impulse; those of the vessel to
/// state.wall_loads too, each to the fields under the particle: that of stress to those that it faced when the
/// neighbour lists were built, that of contact to those where it touches.
struct ContactSetting {
  const Parameters& parameters;
  const Boundary& boundary;
  const SurfaceFields& fields;  ///< of the vessel, which note its loads
  double distance;              ///< Workspace::contact_distance, of particles of mass ratio 1, m
  Share& share;                 ///< walls receive what its particles give, and those of other processes
};

struct ContactStep {
  double duration;  ///< over which velocities have changed by the rates, s
  double step;      ///< over which particles will move with their velocities, s
};

/// After velocities have changed by the rates: adds the loads of the walls to the state, holds the particles that would
/// come nearer to a wall than their contact distance, and applies friction to those that a wall pushes
/// (physics/sph/wall_contact.hpp). \param position where the rates were evaluated, m
void apply_contact(ThreadTeam& team, const ContactSetting& setting, const Rates& rates,
                   std::span<const Vector3> position, const ContactStep& step, PairSums& pairs, State& state);

/// Takes from the velocities with which particles will drift what would bring them nearer to a wall than their contact
/// distance; no wall receives it. \param state its positions and masses \param velocity of each, m/s
void prevent_approach(ThreadTeam& team, const ContactSetting& setting, const Rates& rates, const State& state,
                      double step, PairSums& pairs, std::span<Vector3> velocity);

/// Brings back the particles that have crossed a boundary, as far before it as they were behind it. At a wall they lose
/// their velocity towards it, with friction; at a face of symmetry, and a free face as printed, velocity and history of
/// the law are mirrored. None is left behind a wall. \param neighbourhood of the particles, whose lists were built
/// before the step \param before positions at the start of the step, m
void reflect(ThreadTeam& team, const ContactSetting& setting, const Material& material,
             const Neighbourhood& neighbourhood, std::span<const Vector3> before, State& state);

}  // namespace talus::continuum
