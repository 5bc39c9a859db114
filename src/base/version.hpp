// SPDX-License-Identifier: Apache-2.0
/// Which program this is.
#pragma once

#include <string_view>

namespace talus {

/// "0.2.0": that of project() in CMakeLists.txt
std::string_view program_version();

/// The commit it was built from, with "-dirty" if tracked files differed from it; "unknown" outside a repository.
std::string_view program_revision();

/// "GCC 12.2.0"
std::string_view program_compiler();

}  // namespace talus
