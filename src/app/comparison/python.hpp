// SPDX-License-Identifier: Apache-2.0
/// The Python that evaluates and draws for the program, on the package python/talus; the program does without it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace talus::app {

/// The first python3 of the PATH that has these modules and the package talus; nothing if none has. \param modules
/// {"h5py", "matplotlib"}
std::optional<std::filesystem::path> find_python(const std::vector<std::string>& modules);

/// What a module of the package talus prints. \param input its stdin \param about what an error names
/// \throws FileError with its last line if it fails
std::string said_by_package(const std::filesystem::path& python, const std::string& module,
                            const std::vector<std::string>& arguments, const std::string& input,
                            const std::filesystem::path& about);

/// Draws with talus.charts. \returns the pictures; none, having said what is missing, without a Python that can draw
/// \throws FileError if it fails
std::vector<std::filesystem::path> draw_charts(const std::vector<std::string>& arguments,
                                               const std::filesystem::path& about);

}  // namespace talus::app
