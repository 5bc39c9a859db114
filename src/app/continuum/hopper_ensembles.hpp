// SPDX-License-Identifier: Apache-2.0
/// Runs from a hopper into a bin, one a variant, as Yuu & Umekage 2011 study them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/hopper.hpp"
#include "app/comparison/studied_runs.hpp"

namespace talus::app {

/// The runs of one variant; nothing is random, so there is one, or several that differ in what tells no variants.
struct HopperEnsemble {
  std::string case_name;
  std::string variant;  ///< "vacuum"
  std::vector<std::filesystem::path> folders;
  std::vector<HopperRun> runs;  ///< the same order
};

/// \throws FileError
std::unique_ptr<StudiedRuns> read_hopper_ensembles(const std::vector<FoundEnsemble>& found);

}  // namespace talus::app
