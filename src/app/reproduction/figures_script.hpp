// SPDX-License-Identifier: Apache-2.0
/// A study's figures and its page are drawn by a script beside its reference, validation/STUDY/figures.py, with Python;
/// the program does without it.
#pragma once

#include <filesystem>

namespace talus::app {

/// Runs the script on a reproduction's folder, which holds comparison.json: it leaves figures/ and the page there, and
/// what it says in figures.txt. \returns whether it got through \throws FileError
bool run_figures_script(const std::filesystem::path& python, const std::filesystem::path& script,
                        const std::filesystem::path& folder);

}  // namespace talus::app
