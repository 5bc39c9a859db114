// SPDX-License-Identifier: Apache-2.0
/// Whole files: written so that a reader, a kill or a full disk meets the old file or the new one, never a part.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace talus {

/// Ending of the temporary name, in the same folder, under which a file is written. One that is left by a kill is
/// replaced by the next write of the same file, and removed by --overwrite.
inline constexpr std::string_view temporary_suffix = ".part";

/// Whether a file is on the disk when its writing returns, or when the system finds the time. Either way a kill of the
/// program meets the old file or the new one; a loss of power may meet neither, if it comes within seconds of `later`.
enum class Flush { now, later };

/// Writes `content` under a temporary name, flushes it to the disk, renames it to `path` and flushes the folder. The
/// folder must exist and have room for the new file beside the old one. A folder that keeps a list of what Talus wrote
/// (file_list.hpp) has it entered there. Symbolic links are not followed: one at `path` is replaced or, where such a
/// list is kept, refused; one under the temporary name is refused.
/// \param flush `later` is for what can be made again from other files
/// \throws FileError with the system's reason; the temporary is gone then and an older file at `path` is as it was
///         (only where flushing the folder fails, after the renaming, is it already the new one)
void write_atomically(const std::filesystem::path& path, std::string_view content, Flush flush = Flush::now);

/// \throws FileError with the system's reason
std::string read_whole_file(const std::filesystem::path& path);

/// The text of an error number of the system: "No space left on device".
std::string system_reason(int error_number);

}  // namespace talus
