// SPDX-License-Identifier: Apache-2.0
/// The continuum model as the commands see it.
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/hopper.hpp"
#include "app/prepared_case.hpp"

namespace talus::app {

/// \throws InputError with every problem of the case
PreparedCase prepare_continuum(const CaseFile& file);

/// All parameters of a case of this model, with their defaults.
ParameterList continuum_parameters();

/// What the analysis of a run needs to know of its case. \param resolved the manifest's case
/// \throws InputError
HopperSetting hopper_setting_of(const CaseFile& resolved);

/// Analyses the run in a folder and draws its pictures once more. \param resolved the manifest's case
/// \throws FileError, InputError
std::vector<NamedValue> analyze_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder);

}  // namespace talus::app
