// SPDX-License-Identifier: Apache-2.0
/// The memory still available to this process.
#pragma once

#include <optional>

namespace talus {

/// Bytes: the least of what the system has free for new programs, what the control group of the process (a container, a
/// batch system's job) leaves, and what its limit on address space (`ulimit -v`) does. Nothing if unknown.
std::optional<double> available_memory();

}  // namespace talus
