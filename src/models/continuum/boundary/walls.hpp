// SPDX-License-Identifier: Apache-2.0
/// Wall friction and reflection of particles in a step, and the loads of the walls.
#pragma once

#include <span>

#include "base/parallel.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/pairs/pair_sums.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"

namespace talus::continuum {

/// Whether walls have friction at present.
bool has_wall_friction(const Parameters& parameters, const State& state);

/// What the contact of particles with walls needs to know of a step.
struct ContactStep {
  double duration;  ///< over which velocities have changed by the rates, s
  double step;      ///< over which particles will move with their velocities, s
  double distance;  ///< Workspace::contact_distance, m
};

/// After velocities have changed by the rates: adds the loads of the walls to state.wall_impulse, holds the particles
/// that would come nearer to a wall than their contact distance, and applies friction to those that a wall pushes
/// (physics/sph/wall_contact.hpp). \param position where the rates were evaluated, m
void apply_wall_contact(ThreadTeam& team, const Parameters& parameters, const Domain& domain, const Rates& rates,
                        std::span<const Vector3> position, const ContactStep& step, State& state);

/// Takes from the velocities with which particles will drift what would bring them nearer to a wall than their contact
/// distance; no wall receives it. \param velocity of each, m/s
void hold_off_walls(ThreadTeam& team, const Domain& domain, const Rates& rates, std::span<const Vector3> position,
                    const ContactStep& step, std::span<Vector3> velocity);

/// Brings back the particles that have crossed a boundary, as far before it as they were behind it. At a wall they lose
/// their velocity towards it, with friction; at a face of symmetry, and a free face as printed, velocity and history of
/// the law are mirrored. \param before positions at the start of the step, m
void reflect_at_walls(ThreadTeam& team, const Parameters& parameters, const Material& material, const Domain& domain,
                      std::span<const Vector3> before, State& state);

}  // namespace talus::continuum
