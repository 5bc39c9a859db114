// SPDX-License-Identifier: Apache-2.0
/// Where the project's own files are: references, cases.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace talus::app {

/// The folder that holds this file, such as "validation/yuu2011/reference.toml": here, where the program was built, or
/// where it was installed. Nothing if none does.
std::optional<std::filesystem::path> find_project(const std::filesystem::path& file);

/// The path of a file that a user names: as given, or, where there is none, of the project's file of that name, so that
/// `talus run cases/silo-cone.toml` runs from any folder. As given if there is neither.
std::string found_file(const std::string& given);

}  // namespace talus::app
