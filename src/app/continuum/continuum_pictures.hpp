// SPDX-License-Identifier: Apache-2.0
/// The pictures of a run of the continuum model.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/continuum/continuum_analysis.hpp"
#include "io/figure/figure.hpp"

namespace talus::app {

/// Particles of one snapshot from the side, coloured by values, within walls and plate.
/// \param positions, radii, values must outlive the picture
figure::ParticlePicture particle_picture(const HopperSetting& setting, std::span<const Vector3> positions,
                                         std::span<const double> radii, figure::ByValue values);

/// Draws, and returns the paths: pictures/frames.png, the grains as dots, six times; pictures/packing.png, the last
/// snapshot coloured by packing; with air pictures/air.png; of a vessel pictures/fields.png and, with
/// an outlet, pictures/flow.png. Curves are drawn by python/talus/charts.py. The tables of analyze_continuum() must be
/// there. \throws FileError
std::vector<std::filesystem::path> draw_continuum(const std::filesystem::path& run_folder, const HopperRun& run,
                                                  const std::string& title);

}  // namespace talus::app
