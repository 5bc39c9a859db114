// SPDX-License-Identifier: Apache-2.0
/// The bed beside the walls of a vessel: rows that follow them.
#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"
#include "models/continuum/boundary/boundary.hpp"

namespace talus::continuum {

/// Moves the particles beside the vessel's walls within their levels until they are evenly spaced, half a spacing from
/// the walls. A lattice that a curved or sloping wall cuts leaves gaps there of up to a spacing, which no stress keeps
/// open: under load its columns slide along the wall, the friction of the wall is lost, and the bed presses on it with
/// up to twice its pressure (validation/silo-loads).
///
/// Particles repel each other, and their mirror images in the walls' planes, as the gradient of a kernel has it.
/// Particles farther than 2.5 spacings from a wall that slopes by more than 30 degrees stay. The packing of particles
/// by a kernel's gradient: Colagrossi, Bouscasse, Antuono & Marrone, Comput. Phys. Commun. 183, 1641 (2012).
///
/// \param spacing of the particles, m \param first number of those that may move; the rest stay
/// \param positions m
void fit_to_walls(ThreadTeam& team, const Boundary& boundary, double spacing, std::size_t first,
                  std::vector<Vector3>& positions);

}  // namespace talus::continuum
