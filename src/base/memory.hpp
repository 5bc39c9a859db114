// SPDX-License-Identifier: Apache-2.0
/// The memory still available to this process, and the disk.
#pragma once

#include <filesystem>
#include <optional>

namespace talus {

/// Bytes: the least of what the system has free for new programs, what the control group of the process (a container, a
/// batch system's job) leaves, and what its limit on address space (`ulimit -v`) does. Nothing if unknown.
std::optional<double> available_memory();

/// Bytes that can be written to the file system of a folder, or of the nearest folder above it that exists; nothing
/// where that cannot be said.
std::optional<double> available_disk(const std::filesystem::path& folder);

}  // namespace talus
