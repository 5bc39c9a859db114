// SPDX-License-Identifier: Apache-2.0
#include "base/program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace talus {

std::optional<std::filesystem::path> find_program(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder) / name;
    std::error_code none;
    if (!folder.empty() && std::filesystem::is_regular_file(program, none) && ::access(program.c_str(), X_OK) == 0)
      return program;
  }
  return std::nullopt;
}

}  // namespace talus
