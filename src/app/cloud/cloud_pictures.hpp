// SPDX-License-Identifier: Apache-2.0
/// The pictures of a cloud's run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cloud/cloud_analysis.hpp"

namespace talus::app {

/// Draws snapshots into pictures/, of an avalanche with its heads marked; returns the paths.
/// \throws FileError
std::vector<std::filesystem::path> draw_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame,
                                              const std::string& title);

}  // namespace talus::app
