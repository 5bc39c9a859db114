// SPDX-License-Identifier: Apache-2.0
/// What is measured on a run of the continuum model, from its folder alone. The estimators are those of
/// analysis/hopper.hpp.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "analysis/hopper.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/setup/setup.hpp"
#include "numerics/run_record.hpp"

namespace talus::app {

/// What is drawn of a vessel: the section through its middle with its gates open; nothing without one.
std::vector<std::array<Vector3, 2>> section_of_vessel(const continuum::Layout& layout);

/// The case as the analysis needs it.
HopperSetting hopper_setting(const continuum::Setup& setup);

/// Reads series.csv; a snapshot when a measure asks for it. \throws FileError
HopperRun read_hopper(const std::filesystem::path& run_folder, const HopperSetting& setting,
                      std::size_t snapshot_memory);

/// Writes analysis/snapshots.csv (a column per measure), analysis/surfaces.csv (both free surfaces at the end)
/// and, with a plate, analysis/discharge.csv (means over T, one every T/4); with the outlet of a vessel
/// analysis/residence.csv (when ten layers of the bed leave it); returns the summary's quantities.
/// \throws FileError
std::vector<NamedValue> analyze_continuum(const std::filesystem::path& run_folder, const HopperRun& run);

}  // namespace talus::app
