// SPDX-License-Identifier: Apache-2.0
/// The walls of a vessel between which a bed lies: the lattice of the bed is fitted to them, whatever other walls there
/// are, a collar above the bed, a flange, or the outer face of a sheet that has two.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "models/continuum/boundary/boundary.hpp"
#include "models/continuum/setup/parameters.hpp"

namespace talus::continuum {

/// Where the walls end that the grains touch, m.
struct BedWalls {
  /// Least and largest x, least and largest y; of none where grains of the bed see no wall of the vessel beyond.
  std::array<std::optional<double>, 4> ends;

  // What they were found for.
  std::weak_ptr<const Boundary> boundary;
  BedRegion region;
  double spacing = 0;
};

/// The parameters with the walls of their beds; those of several beds have the widest in common, as particles of one
/// mass. Walls are found by the places that a bed fills in a lattice as wide as the vessel: on each side the wall that
/// the outermost of them see first, and of a wall all that turns on without an edge and faces the same way, so that a
/// cone is as wide as the bin on it. Of an upright one of a file it is what lies in the heights of the bed.
/// \param boundary of the parameters
Parameters with_walls_of_beds(Parameters parameters, const std::shared_ptr<const Boundary>& boundary);

}  // namespace talus::continuum
