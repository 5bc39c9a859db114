// SPDX-License-Identifier: Apache-2.0
/// Figures in the manner of Niiya, Awazu & Nishimori 2020, Figures 3 to 11.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cloud/avalanche_ensembles.hpp"

namespace talus::app {

/// Draws what the ensembles that are there allow; the first caption says which figures are left out for want of a
/// finished run. Particles are those of the first member at the largest radius.
/// \param folder made if needed; \throws FileError
std::vector<FigureOfStudy> draw_niiya2020(const std::vector<AvalancheEnsemble>& ensembles,
                                          const std::filesystem::path& folder);

}  // namespace talus::app
