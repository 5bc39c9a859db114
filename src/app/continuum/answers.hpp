// SPDX-License-Identifier: Apache-2.0
/// What a run of a vessel answers, in the words of its user, each number beside that of the hand formula.
#pragma once

#include <filesystem>
#include <vector>

#include "models/continuum/parameters.hpp"
#include "numerics/named_value.hpp"

namespace talus::app {

/// Discharge, emptying time, residue, kind of flow and, of each upright or conical wall, the largest pressure at rest;
/// what the case does not have is left out. \param quantities of the summary \param run_folder with
/// analysis/wall_loads.csv, if the vessel has loads \throws FileError
std::vector<Answer> answers_of(const continuum::Parameters& parameters, const std::vector<NamedValue>& quantities,
                               const std::filesystem::path& run_folder);

}  // namespace talus::app
