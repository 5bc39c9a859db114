// SPDX-License-Identifier: Apache-2.0
/// Fields of the grains in a vessel, means and deviations over the window in which it flows.
#pragma once

#include <filesystem>
#include <string>

#include "analysis/hopper.hpp"

namespace talus::app {

/// Writes analysis/fields.vtkhdf, cells of two spacings over the vessel, of the snapshots while 10 to 50 % of the bed
/// leave it; without an outlet of those since the gate opened; of the snapshot nearest to the middle of that time if
/// there is none within. Nothing without snapshots. \throws FileError
void write_fields(const std::filesystem::path& run_folder, const HopperRun& run, const Vector3& low,
                  const Vector3& high);

/// The section of that through the middle of the vessel: velocity, pressure, packing and inertial number.
/// \returns false without the file \throws FileError
bool draw_fields(const std::filesystem::path& run_folder, const HopperSetting& setting, const std::string& title,
                 const std::filesystem::path& path);

}  // namespace talus::app
