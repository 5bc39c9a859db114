// SPDX-License-Identifier: Apache-2.0
#include "app/project/project.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "base/system.hpp"
#include "base/text.hpp"
#include "run/program.hpp"

namespace talus::app {

namespace {

/// So that Python finds the package talus, of the project or where it is installed, and the package this program; of
/// several processes the one for one, since what a process starts is none of them.
void name_package_and_program() {
  std::filesystem::path program = run::own_program();
  if (program.filename() == "talus-mpi") program.replace_filename("talus");
  setenv("TALUS", program.c_str(), 1);
  const auto project = find_project("python/talus/measures.py");
  if (!project) return;
  const std::string path = std::filesystem::absolute(*project / "python").lexically_normal().string();
  const char* const others = std::getenv("PYTHONPATH");
  if (!others || !*others)
    setenv("PYTHONPATH", path.c_str(), 1);
  else if (!std::string_view(others).starts_with(path))
    setenv("PYTHONPATH", (path + ":" + others).c_str(), 1);
}

/// -B: nothing is left beside the modules. -P: what lies in the current folder is not imported.
std::vector<std::string> command_of(const std::filesystem::path& python, const std::string& module,
                                    const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {python.string(), "-B", "-P", "-X", "utf8", "-m", module};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

bool has_modules(const std::filesystem::path& python, const std::vector<std::string>& modules) {
  constexpr const char* ask =
      "import sys; from importlib.util import find_spec; sys.exit(not all(map(find_spec, sys.argv[1:])))";
  std::vector<std::string> command = {python.string(), "-P", "-c", ask, "talus"};
  command.insert(command.end(), modules.begin(), modules.end());
  return run::run_program(command).status == 0;
}

/// Of a traceback, the error itself.
std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

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

std::optional<std::filesystem::path> find_python(const std::vector<std::string>& modules) {
  name_package_and_program();
  for (const std::filesystem::path& python : find_programs("python3"))
    if (has_modules(python, modules)) return python;
  return std::nullopt;
}

ExitStatus become_package(const std::string& command, const std::vector<std::string>& arguments) {
  auto python = find_python({"numpy", "h5py", "matplotlib"});
  if (!python) python = find_python({"numpy", "h5py"});
  if (!python) {
    print_error(
        "talus: {} takes python3 with numpy, h5py and the package talus (Debian: python3-numpy, python3-h5py, "
        "python3-talus)\n",
        command);
    return ExitStatus::not_met;
  }
  std::fflush(nullptr);
  const std::vector<std::string> words = command_of(*python, "talus.lab." + command, arguments);
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  execv(pointers[0], pointers.data());
  throw FileError(python->string(), std::string("cannot be started: ") + std::strerror(errno));
}

std::string said_by_package(const std::filesystem::path& python, const std::string& module,
                            const std::vector<std::string>& arguments, const std::filesystem::path& about) {
  const run::ProgramEnd end = run::run_program(command_of(python, module, arguments));
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
  std::istringstream said(said_by_package(*python, "talus.charts", arguments, about));
  std::vector<std::filesystem::path> drawn;
  for (std::string line; std::getline(said, line);) drawn.emplace_back(line);
  return drawn;
}

}  // namespace talus::app
