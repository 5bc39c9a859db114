// SPDX-License-Identifier: Apache-2.0
/// The continuum model as the commands see it.
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/hopper.hpp"
#include "app/case/prepared_case.hpp"
#include "app/case/scene.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// \throws InputError with every problem of the case
PreparedCase prepare_continuum(const CaseFile& file);

/// All parameters of a case of this model, with their defaults.
ParameterList continuum_parameters();

/// What the analysis of a run needs to know of its case. \param resolved the manifest's case
/// \throws InputError
HopperSetting hopper_setting_of(const CaseFile& resolved);

/// As ModelEntry (models.hpp) has them. \param resolved the manifest's case
std::vector<NamedValue> analyse_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder);
/// Box, walls and gates.
Scene scene_of_continuum(const CaseFile& resolved);
std::vector<std::filesystem::path> draw_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder);

}  // namespace talus::app
