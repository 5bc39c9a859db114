// SPDX-License-Identifier: Apache-2.0
/// Cases of the model `air`.
#pragma once

#include <filesystem>
#include <vector>

#include "app/case/prepared_case.hpp"
#include "app/case/read_runs.hpp"
#include "app/case/scene.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// Reads a case of air alone. \throws InputError with every problem
PreparedCase prepare_air(const CaseFile& file);

/// As ModelEntry (models.hpp) has them. The scene is the box; the analysis the last row of the series.
Scene scene_of_air(const CaseFile& resolved);
std::vector<NamedValue> analyse_air_run(const CaseFile& resolved, const std::filesystem::path& folder, ReadRuns& runs);

}  // namespace talus::app
