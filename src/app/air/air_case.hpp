// SPDX-License-Identifier: Apache-2.0
/// Cases of the model `air`.
#pragma once

#include <filesystem>
#include <vector>

#include "app/case/prepared_case.hpp"
#include "app/case/scene.hpp"
#include "io/case_file.hpp"

namespace talus::app {

/// Reads a case of air alone. \throws InputError with every problem
PreparedCase prepare_air(const CaseFile& file);

/// As ModelEntry (models.hpp) has it: the last row of the series.
/// The box.
Scene scene_of_air(const CaseFile& resolved);
std::vector<NamedValue> analyse_air_run(const CaseFile& resolved, const std::filesystem::path& folder);

}  // namespace talus::app
