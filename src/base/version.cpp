// SPDX-License-Identifier: Apache-2.0
#include "base/version.hpp"

#include "revision.hpp"  // written by tools/revision.cmake

namespace talus {

std::string_view program_version() {
  return generated::version;
}

std::string_view program_revision() {
  return generated::revision;
}

std::string_view program_compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

}  // namespace talus
