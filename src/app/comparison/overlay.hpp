// SPDX-License-Identifier: Apache-2.0
/// Two runs side by side.
#pragma once

#include <filesystem>

#include "base/error.hpp"

namespace talus::app {

/// Prints the quantities of both summaries with their differences, says which keys of the cases differ, and, where a
/// picture is asked for, draws every series that both have.
/// \param picture PNG; empty: none
/// \throws FileError
ExitStatus compare_runs(const std::filesystem::path& a, const std::filesystem::path& b,
                        const std::filesystem::path& picture);

}  // namespace talus::app
