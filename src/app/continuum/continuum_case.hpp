// SPDX-License-Identifier: Apache-2.0
/// The continuum model as the commands see it.
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/hopper.hpp"
#include "app/case/prepared_case.hpp"
#include "app/case/read_runs.hpp"
#include "app/case/scene.hpp"
#include "app/case/studied_run.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// \throws InputError with every problem of the case
PreparedCase prepare_continuum(const CaseFile& file);

/// All parameters of a case of this model, with their defaults.
ParameterList continuum_parameters();

/// The run in a folder. \param resolved the manifest's case \throws FileError, InputError
const HopperRun& hopper_run_of(const CaseFile& resolved, const std::filesystem::path& folder, ReadRuns& runs);
StudiedRun study_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder, ReadRuns& runs);

/// As ModelEntry (models.hpp) has them. \param resolved the manifest's case
std::vector<NamedValue> analyse_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                              ReadRuns& runs);
/// Box, walls and gates.
Scene scene_of_continuum(const CaseFile& resolved, const std::filesystem::path& folder, ReadRuns& runs);
std::vector<Answer> answer_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                         const std::vector<NamedValue>& quantities, ReadRuns& runs);
/// The middle of the discharge, from the opening of the gate, s; nothing where there is none.
std::optional<double> telling_time_of_continuum(const CaseFile& resolved, const std::filesystem::path& folder,
                                                ReadRuns& runs);
std::vector<std::filesystem::path> draw_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                                      ReadRuns& runs);

}  // namespace talus::app
