// SPDX-License-Identifier: Apache-2.0
/// Writing a file whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace talus {

/// Writes `bytes` under a temporary name in the folder of `path` and renames it into place, so that a reader meets the
/// old file or the new one, never a part of one. The folder must exist.
/// \throws FileError if that fails; nothing is left behind then, and an older file stays as it was
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace talus
