// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/python.hpp"

#include <cstdlib>

#include "app/comparison/project.hpp"
#include "base/program.hpp"
#include "run/interrupt.hpp"
#include "run/jobs.hpp"

namespace talus::app {

std::optional<std::filesystem::path> find_python(const std::string& modules) {
  for (const std::filesystem::path& python : find_programs("python3"))
    if (run::run_program({python.string(), "-c", "import " + modules}, {}, [] {
          return run::signal_has_come();
        }).status == 0)
      return python;
  return std::nullopt;
}

std::vector<std::string> with_package(std::vector<std::string> command) {
  const auto project = find_project("python/talus/measures.py");
  const auto env = find_program("env");
  if (!project || !env) return command;
  std::string path = "PYTHONPATH=" + std::filesystem::absolute(*project / "python").string();
  if (const char* others = std::getenv("PYTHONPATH"); others && *others) path += std::string(":") + others;
  command.insert(command.begin(), {env->string(), path});
  return command;
}

}  // namespace talus::app
