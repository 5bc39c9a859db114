// SPDX-License-Identifier: Apache-2.0
/// Where the bed of a case lies, for `talus check`: in words and as a picture.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "models/continuum/setup/setup.hpp"

namespace talus::app {

/// Lines of a name and a text: particles and mass, extents, what the bed lies against, columns of bed.file that are not
/// read.
std::vector<std::pair<std::string, std::string>> bed_lines(const continuum::Layout& layout);

/// Writes sections of walls and bed, each particle by its size, through the middle of the bed, across y and across x,
/// as a PNG. Gates are shut. \throws FileError
void draw_bed(const continuum::Setup& setup, const std::string& title, const std::filesystem::path& path);

}  // namespace talus::app
