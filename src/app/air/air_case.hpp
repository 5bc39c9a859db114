// SPDX-License-Identifier: Apache-2.0
/// Cases of the model `air`.
#pragma once

#include <filesystem>
#include <memory>

#include "app/case/prepared_case.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// Reads a case of air alone. \throws InputError with every problem
PreparedCase prepare_air(const CaseFile& file);

/// As ModelEntry (models.hpp) has it. The scene is the box; the analysis the last row of the series.
std::unique_ptr<OpenedRun> open_air_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                        std::size_t snapshot_memory);

}  // namespace talus::app
