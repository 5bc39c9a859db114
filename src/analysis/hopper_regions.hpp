// SPDX-License-Identifier: Apache-2.0
/// Where particles are in a hopper above a bin: deep below a free surface. x across, z up from the bin's floor.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/free_surface.hpp"
#include "base/vector.hpp"

namespace talus {

/// The two vessels, one above the other; without a plate the box alone, as a bin.
struct HopperShape {
  double width = 0, depth = 0, height = 0;  ///< of the box, from 0, m
  struct Plate {
    double height = 0;                     ///< between the vessels, m
    double slit_left = 0, slit_right = 0;  ///< of its slit, x, m
  };
  std::optional<Plate> plate = {};
  double spacing = 0;  ///< h, of the particles at the start, m

  double middle() const { return 0.5 * width; }
  Vessel bin() const;
  /// \throws std::bad_optional_access without a plate
  Vessel hopper() const;
};

/// Free surfaces at one time; that of the hopper has no heights if there is no plate.
struct HopperSurfaces {
  FreeSurface bin, hopper;
};
HopperSurfaces hopper_surfaces(const Section& packing, const HopperShape& shape);

/// The particles deeper than 3 h below the free surface of their vessel, and not within 3 h of the slit's opening in z.
std::vector<bool> deep_particles(std::span<const Vector3> position, const HopperSurfaces& surfaces,
                                 const HopperShape& shape);

/// Mean of a column over the particles with from < z < to; nan if there are none.
double mean_between(std::span<const Vector3> position, std::span<const double> values, double from, double to);

/// The particles at or above the plate; without one, above the floor.
std::vector<bool> above_outlet(std::span<const Vector3> position, const HopperShape& shape);

}  // namespace talus
