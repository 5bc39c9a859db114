// SPDX-License-Identifier: Apache-2.0
/// Programs that Talus uses where they are there: ffmpeg, sbatch, python3.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace talus {

/// The programs of this name in the folders of PATH that may be executed, in the order of the folders. An empty entry
/// of PATH is passed over: what lies in the current folder is not run. Without a PATH, those of the system's own.
std::vector<std::filesystem::path> find_programs(std::string_view name);

/// The first of them.
std::optional<std::filesystem::path> find_program(std::string_view name);

}  // namespace talus
