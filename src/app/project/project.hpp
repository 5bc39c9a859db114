// SPDX-License-Identifier: Apache-2.0
/// Where the project's own files are: references, cases, and the package python/talus, which evaluates and draws for
/// the program. Runs and their summaries do without it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace talus::app {

/// The folder that holds this file, such as "validation/yuu2011/reference.toml": here, where the program was built, or
/// where it was installed. Nothing if none does.
std::optional<std::filesystem::path> find_project(const std::filesystem::path& file);

/// The path of a file that a user names: as given, or, where there is none, of the project's file of that name, so that
/// `talus run cases/silo-cone.toml` runs from any folder. As given if there is neither.
std::string found_file(const std::string& given);

/// The first python3 of the PATH that has these modules and the package talus; nothing if none has. \param modules
/// {"h5py", "matplotlib"}
std::optional<std::filesystem::path> find_python(const std::vector<std::string>& modules);

/// Replaces the program by a module of the package: what `talus ensemble` and others do. \returns not_met, having said
/// which packages are missing, without a Python that has them \throws FileError if it cannot be started
ExitStatus become_package(const std::string& command, const std::vector<std::string>& arguments);

/// What a module of the package talus prints. \param about what an error names
/// \throws FileError with the last line of its errors if it fails
std::string said_by_package(const std::filesystem::path& python, const std::string& module,
                            const std::vector<std::string>& arguments, const std::filesystem::path& about);

/// Draws with talus.charts. \returns the pictures; none, having said what is missing, without a Python that can draw
/// \throws FileError if it fails
std::vector<std::filesystem::path> draw_charts(const std::vector<std::string>& arguments,
                                               const std::filesystem::path& about);

}  // namespace talus::app
