// SPDX-License-Identifier: Apache-2.0
/// Particles split where finer ones are wanted, and merge where coarser ones are (setup/levels.hpp).
///
/// Split: into eight in the corners of a cube of half the particle's size, one face along the nearest wall, about the
/// axis of a sector into two, one above the other; all keep velocity, density, stress and history: mass, momentum,
/// energy and volume stay. Merge: those of a level in a cell of twice its spacing, 4 to 12 of them, in a sector in
/// cells of rings, two or three halves in a ring of bed.spacing; mass, momentum and volume stay, stress and history
/// become their means by volume; kinetic energy falls by that of the motion about the common centre, which is summed.
/// Both happen when neighbour lists are built.
///
/// Of several processes each splits its own, whose parts follow in the order of all; a cell is merged by the process in
/// whose part of space its middle is, to which its particles go.
///
/// Source: Vacondio, Rogers, Stansby, Mignosa & Feldman, Comput. Methods Appl. Mech. Eng. 256, 132 (2013), on
/// conservation; the patterns are of this model.
#pragma once

#include "models/continuum/boundary/boundary.hpp"
#include "models/continuum/setup/levels.hpp"
#include "models/continuum/setup/setup.hpp"
#include "models/continuum/share.hpp"
#include "models/continuum/state.hpp"

namespace talus::continuum {

/// Together, of several processes. \pre no halo, positions are within the sector, if there is one
void split_and_merge(const Levels& levels, const Boundary& boundary, const Parameters& parameters, Share& share,
                     State& state);

/// Merges the particles of a bed of bed.spacing, of which only positions, velocities, densities and tags are there yet.
void lay_levels(const Setup& setup, State& state);

}  // namespace talus::continuum
