// SPDX-License-Identifier: Apache-2.0
#include "base/program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace talus {

namespace {

std::string search_path() {
  if (const char* path = std::getenv("PATH")) return path;
  std::string path(confstr(_CS_PATH, nullptr, 0), '\0');  // POSIX: where the standard utilities are
  confstr(_CS_PATH, path.data(), path.size());
  return path.c_str();
}

}  // namespace

std::vector<std::filesystem::path> find_programs(std::string_view name) {
  std::vector<std::filesystem::path> found;
  std::istringstream folders(search_path());
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder) / name;
    std::error_code none;
    if (!folder.empty() && std::filesystem::is_regular_file(program, none) && ::access(program.c_str(), X_OK) == 0)
      found.push_back(program);
  }
  return found;
}

std::optional<std::filesystem::path> find_program(std::string_view name) {
  const auto found = find_programs(name);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

}  // namespace talus
