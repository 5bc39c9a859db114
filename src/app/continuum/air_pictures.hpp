// SPDX-License-Identifier: Apache-2.0
/// Pictures of the air in a run of the continuum model.
#pragma once

#include <filesystem>
#include <string>

#include "app/continuum/continuum_analysis.hpp"

namespace talus::app {

/// The middle layer of the air: its pressure as colour, its velocity as arrows, 0.17 s, 0.2 s and 1.0 s after the
/// gate's opening as far as the run goes, or at its end: in the manner of Yuu & Umekage's Figures 10 and 11.
/// \returns false, drawing nothing, if the run has no snapshots of air \throws FileError
bool draw_air(const std::filesystem::path& run_folder, const HopperSetting& setting, const std::string& title,
              const std::filesystem::path& path);

}  // namespace talus::app
