// SPDX-License-Identifier: Apache-2.0
/// Figures in the manner of Niiya, Awazu & Nishimori 2020, Figures 3 to 11.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/comparison/evaluation.hpp"

namespace talus::app {

struct FigureOfStudy {
  std::filesystem::path path;
  std::string caption;
};

/// Draws what the ensembles that are there allow: figures and panels of cases without a finished run are left out.
/// Particles are those of the first member at the largest radius. \param folder made if needed; \throws FileError
std::vector<FigureOfStudy> draw_niiya2020(const std::vector<StudiedEnsemble>& ensembles,
                                          const std::filesystem::path& folder);

}  // namespace talus::app
