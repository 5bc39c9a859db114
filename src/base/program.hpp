// SPDX-License-Identifier: Apache-2.0
/// Programs that Talus uses where they are there: ffmpeg, sbatch.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace talus {

/// The first program of this name in the folders of PATH that may be executed.
std::optional<std::filesystem::path> find_program(std::string_view name);

}  // namespace talus
