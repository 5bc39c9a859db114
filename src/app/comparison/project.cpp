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

}  // namespace talus::app
