// SPDX-License-Identifier: Apache-2.0
/// Where the project's own files are: references, cases.
#pragma once

#include <filesystem>
#include <optional>

namespace talus::app {

/// The folder that holds this file, such as "validation/yuu2011/reference.toml": here, where the program was built, or
/// where it was installed. Nothing if none does.
std::optional<std::filesystem::path> find_project(const std::filesystem::path& file);

}  // namespace talus::app
