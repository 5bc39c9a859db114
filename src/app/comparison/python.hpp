// SPDX-License-Identifier: Apache-2.0
/// The Python that evaluates and draws for the program, on the package python/talus; the program does without it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace talus::app {

/// The first python3 of the PATH that has these modules; nothing if none has. \param modules "h5py, matplotlib"
std::optional<std::filesystem::path> find_python(const std::string& modules);

/// A command that finds the package talus: of the project, or where it is installed.
std::vector<std::string> with_package(std::vector<std::string> command);

}  // namespace talus::app
