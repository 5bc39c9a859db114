// SPDX-License-Identifier: Apache-2.0
/// The phases of a run: the bed settles, the gate opens, the grains flow.
#pragma once

#include "models/continuum/workspace.hpp"

namespace talus::continuum {

/// Whether a particle in a free surface is as loose as the kernel, half empty there, says it is. Eq. 16 keeps what
/// separates a density from the kernel's sum, wherever the particle goes: one that began at a free surface with the
/// density of the bed would be buried at a packing of 0.51 and bear as much there as others at 0.6. A body that bears
/// tension would pull its own skin in; its surfaces stay surfaces.
bool is_loose_where_free(const Parameters& parameters);

/// sph.density_relaxation where it holds, else 0: what a shear strain of 1 takes back of the difference between the
/// kernel's sum and the density. Eq. 16 is the rate of the kernel's sum for a constant smoothing length and between
/// mirrors; what else there is adds up with the strain (docs/design/stabilisation.md).
double density_relaxation(const Parameters& parameters);

/// Whether they are drawn by the shear that lasts (State::lasting_rate) and not by each step's. Particles beside a
/// round wall of a vessel jitter: a shear to and fro, by which a density loses nothing that would have to be taken
/// back, and beside walls the kernel's sum is some per cent off (docs/design/stabilisation.md).
bool draws_by_lasting_rate(const Parameters& parameters);

/// The densities begin as the kernel's sums with the bed's smoothing length, though nowhere above the bed's: beside a
/// wall at an angle the images are not a lattice, and the sum is some per cent off.
void begin_densities(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

/// Finds out whether the bed is at rest, and opens the gates whose time has come.
/// \throws NumericalError for a bed that does not settle in time
void update_phase(ThreadTeam& team, const Setup& setup, State& state, Workspace& workspace);

}  // namespace talus::continuum
