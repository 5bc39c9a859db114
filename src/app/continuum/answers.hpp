// SPDX-License-Identifier: Apache-2.0
/// The key results of a run with an outlet or walls: what its user asks, in the units of an engineer, each beside its
/// analytical estimate.
#pragma once

#include <filesystem>
#include <vector>

#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/setup/setup.hpp"
#include "numerics/run_record.hpp"

namespace talus::app {

/// First how the flow ended: emptied, stopped (when, with how much left), not begun, or still flowing. Then flow
/// regime, steady and peak discharge, emptying time, and of each wall the largest pressure at rest, in flow and at its
/// peak. What cannot be known yet says so; what the case does not have is left out. \param quantities of the summary
/// \param end of the run, from the opening of the gate, s
/// \param run_folder with analysis/wall_loads.csv and analysis/box_walls.csv, if there are loads \throws FileError
std::vector<Answer> answers_of(const continuum::Setup& setup, const std::vector<NamedValue>& quantities, double end,
                               const std::filesystem::path& run_folder);

}  // namespace talus::app
