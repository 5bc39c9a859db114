// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/project.hpp"

#include "run/jobs.hpp"

namespace talus::app {

std::optional<std::filesystem::path> find_project(const std::filesystem::path& file) {
  const std::filesystem::path program = run::own_program();
  for (const auto& candidate : {std::filesystem::path("."), program.parent_path().parent_path(),
                                program.parent_path().parent_path() / "share" / "talus"})
    if (std::filesystem::exists(candidate / file)) return candidate;
  return std::nullopt;
}

std::string found_file(const std::string& given) {
  const std::filesystem::path path = given;
  if (given.empty() || path.is_absolute() || std::filesystem::exists(path)) return given;
  const auto project = find_project(path);
  return project && std::filesystem::is_regular_file(*project / path) ? (*project / path).lexically_normal().string()
                                                                      : given;
}

}  // namespace talus::app
