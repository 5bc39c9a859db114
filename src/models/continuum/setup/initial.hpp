// SPDX-License-Identifier: Apache-2.0
/// The grains at the start: particles on a regular lattice, at rest, or those of a file; without stress.
#pragma once

#include "base/parallel.hpp"
#include "models/continuum/setup/setup.hpp"
#include "models/continuum/state.hpp"

namespace talus::continuum {

/// Fills the bed of the case with the lattice of the layout. Source: Yuu & Umekage 2011, section 3 ("The initial
/// imaginary particle configuration is regular and uniform"); bed.disorder then moves each particle by so much, at
/// random by the case's seed. Particles of bed.file have their own positions, and velocities and densities where the
/// file has them. \param part of so many parts, as equal as can be, in the order of the particles: only it is kept
State initial_state(const Setup& setup, ThreadTeam& team, int part = 0, int parts = 1);
/// By one thread.
State initial_state(const Setup& setup, int part = 0, int parts = 1);

}  // namespace talus::continuum
