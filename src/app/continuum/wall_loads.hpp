// SPDX-License-Identifier: Apache-2.0
/// The load of a vessel's walls by patch and height, beside the hand formulas: tables and a picture of a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/hopper.hpp"
#include "models/continuum/parameters.hpp"

namespace talus::app {

/// The bands of a vessel's walls, as the series names them (models/continuum/vessel_loads.hpp).
std::vector<BandOfWall> bands_of(const continuum::Parameters& parameters);

/// The pressure on a band by hand, Pa; nan where there is no formula for it.
struct PressureByHand {
  double at_rest = HopperRun::none, in_flow = HopperRun::none;
};

/// On upright round or square walls K times Janssen's stress; on a level band that stress; on a cone Walker's pressure,
/// the bed above it a surcharge by Janssen. \param ratio K, as measured in the bed at rest \param top of the bed, m
/// \param height of the place, m
PressureByHand pressure_by_hand(const continuum::Parameters& parameters, const BandOfWall& band, double ratio,
                                double top, double height);

/// Writes analysis/wall_loads.csv (a row per band: patch, from 1, heights, area, BandLoad, by hand) and
/// analysis/wall_stress.csv (pressure and shear of each band against time); nothing without a vessel. \throws FileError
void write_wall_loads(const std::filesystem::path& run_folder, const HopperRun& run,
                      const continuum::Parameters& parameters);

/// pictures/wall_loads.png: pressure against height at rest, in flow and by hand. \param flows whether there is an
/// outlet \returns false without the table
bool draw_wall_loads(const std::filesystem::path& run_folder, bool flows, const std::string& title,
                     const std::filesystem::path& path);

}  // namespace talus::app
