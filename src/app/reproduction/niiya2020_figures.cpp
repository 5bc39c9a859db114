// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_figures.hpp"

namespace talus::app {

std::vector<FigureOfStudy> draw_niiya2020(const std::vector<StudiedEnsemble>&, const std::filesystem::path&) {
  return {};
}

}  // namespace talus::app
