// SPDX-License-Identifier: Apache-2.0
/// A paper's runs, all of them, and the paper's numbers beside ours.
#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"

namespace talus::app {

struct StudyRequest {
  std::string study;  ///< folder in validation/
  bool quick = false;
  bool resume = false;
  int jobs = 1;
  int members = 0;                         ///< 0: as many as the paper has (fewer with quick)
  std::vector<std::string> variants = {};  ///< labels of the reference's variants; empty: all (fewer with quick)
  std::filesystem::path folder;
};

/// The studies there are.
inline constexpr const char* study_names[] = {"niiya2020", "yuu2011", "yuu2011/laws", "dem-hopper"};

/// Runs every member of every case and radius of validation/STUDY/reference.toml that is not done yet, evaluates all
/// rows, and writes comparison.txt and comparison.json into the folder; the page and its figures are left to
/// validation/STUDY/figures.py, where there is a Python that can draw.
/// \returns done, not_met if a row is not met, interrupted
/// \throws FileError, InputError
ExitStatus reproduce(const StudyRequest& request);

}  // namespace talus::app
