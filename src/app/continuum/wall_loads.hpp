// SPDX-License-Identifier: Apache-2.0
/// The load of a vessel's walls by patch and height, beside the hand formulas: tables of a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/hopper.hpp"
#include "models/continuum/setup/setup.hpp"

namespace talus::app {

/// The bands of a vessel's walls, as the series names them (models/continuum/boundary/vessel_loads.hpp).
std::vector<BandOfWall> bands_of(const continuum::Layout& layout);

/// Writes analysis/wall_loads.csv (a row per band: patch, from 1, heights, area, BandLoad, analytical estimates, loads
/// of EN 1991-4), analysis/en1991.csv (design_code.hpp) and analysis/wall_stress.csv (pressure and shear of each band
/// against time); nothing without a vessel. \throws FileError
void write_wall_loads(const std::filesystem::path& run_folder, const HopperRun& run, const continuum::Setup& setup);

/// Writes analysis/box_walls.csv: of the faces of the box and a level plate on which the bed lies, the mean pressure
/// over the area that it covers at the start, at rest, in flow and at its peak. Nothing where the walls of a vessel, a
/// wedge or plates hold the bed, or where it stands apart from the side faces. \throws FileError
void write_box_walls(const std::filesystem::path& run_folder, const HopperRun& run, const continuum::Setup& setup);

}  // namespace talus::app
