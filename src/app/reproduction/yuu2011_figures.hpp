// SPDX-License-Identifier: Apache-2.0
/// Figures in the manner of Yuu & Umekage 2011, Figures 4 to 12.
#pragma once

#include <filesystem>
#include <vector>

#include "app/comparison/studied_runs.hpp"
#include "app/continuum/hopper_ensembles.hpp"

namespace talus::app {

/// Draws what the runs that are there allow: curves of all variants over each other, pictures of each.
/// \param folder made if needed; \throws FileError
std::vector<FigureOfStudy> draw_yuu2011(const std::vector<HopperEnsemble>& ensembles,
                                        const std::filesystem::path& folder);

}  // namespace talus::app
