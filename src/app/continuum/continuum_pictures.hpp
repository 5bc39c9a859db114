// SPDX-License-Identifier: Apache-2.0
/// The pictures of a run of the continuum model.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/continuum/continuum_analysis.hpp"

namespace talus::app {

/// Draws, and returns the paths: pictures/frames.png, the grains as dots in the manner of Yuu & Umekage's Figure 4 (at
/// their times, as far as the run goes, or at the start, a fifth, half and all of it); pictures/packing.png, the last
/// snapshot coloured by packing; with a plate pictures/discharge.png and pictures/surface_angle.png. The tables of
/// analyze_continuum() must be there. \throws FileError
std::vector<std::filesystem::path> draw_continuum(const std::filesystem::path& run_folder, const HopperSetting& setting,
                                                  const std::string& title);

}  // namespace talus::app
