// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/python.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "app/comparison/project.hpp"
#include "base/error.hpp"
#include "base/system.hpp"
#include "base/text.hpp"
#include "run/interrupt.hpp"
#include "run/jobs.hpp"

namespace talus::app {

namespace {

/// So that it finds the package talus: of the project, or where it is installed.
std::vector<std::string> with_package(std::vector<std::string> command) {
  const auto project = find_project("python/talus/measures.py");
  const auto env = find_program("env");
  if (!project || !env) return command;
  std::string path = "PYTHONPATH=" + std::filesystem::absolute(*project / "python").string();
  if (const char* others = std::getenv("PYTHONPATH"); others && *others) path += std::string(":") + others;
  command.insert(command.begin(), {env->string(), path});
  return command;
}

bool has_modules(const std::filesystem::path& python, const std::vector<std::string>& modules) {
  constexpr const char* ask =
      "import sys; from importlib.util import find_spec; sys.exit(not all(map(find_spec, sys.argv[1:])))";
  std::vector<std::string> command = {python.string(), "-c", ask, "talus"};
  command.insert(command.end(), modules.begin(), modules.end());
  return run::run_program(with_package(std::move(command)), {}, run::signal_has_come).status == 0;
}

/// Of a traceback, the error itself.
std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

std::optional<std::filesystem::path> find_python(const std::vector<std::string>& modules) {
  for (const std::filesystem::path& python : find_programs("python3"))
    if (has_modules(python, modules)) return python;
  return std::nullopt;
}

std::string said_by_package(const std::filesystem::path& python, const std::string& module,
                            const std::vector<std::string>& arguments, const std::string& input,
                            const std::filesystem::path& about) {
  // -B: nothing is left beside the modules.
  std::vector<std::string> command = {python.string(), "-B", "-m", module};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const run::ProgramEnd end = run::run_program(with_package(std::move(command)), input, run::signal_has_come);
  if (end.status != 0)
    throw FileError(about.string(),
                    fmt::format("{} failed (exit status {}): {}", module, end.status, last_line(end.errors)));
  return end.output;
}

std::vector<std::filesystem::path> draw_charts(const std::vector<std::string>& arguments,
                                               const std::filesystem::path& about) {
  const auto python = find_python({"h5py", "matplotlib"});
  if (!python) {
    print(
        "No pictures of curves: they take python3 with h5py, matplotlib and the package talus (Debian: python3-h5py, "
        "python3-matplotlib, python3-talus).\n");
    return {};
  }
  std::istringstream said(said_by_package(*python, "talus.charts", arguments, {}, about));
  std::vector<std::filesystem::path> drawn;
  for (std::string line; std::getline(said, line);) drawn.emplace_back(line);
  return drawn;
}

}  // namespace talus::app
