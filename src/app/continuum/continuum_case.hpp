// SPDX-License-Identifier: Apache-2.0
/// The continuum model as the commands see it.
#pragma once

#include <filesystem>
#include <memory>

#include "app/case/prepared_case.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// \throws InputError with every problem of the case
PreparedCase prepare_continuum(const CaseFile& file);

/// All parameters of a case of this model, with their defaults.
ParameterList continuum_parameters();

/// As ModelEntry (models.hpp) has it. \param resolved the manifest's case
std::unique_ptr<OpenedRun> open_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                              std::size_t snapshot_memory);

}  // namespace talus::app
