// SPDX-License-Identifier: Apache-2.0
#include "base/system.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>

#include "revision.hpp"  // written by tools/revision.cmake

namespace talus {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The number that follows `name` in a file of names and numbers; infinite if there is none ("max" for no limit).
double number_in(const char* path, const std::string& name) {
  std::ifstream file(path);
  for (std::string word; file >> word;)
    if (word == name) {
      double value = 0;
      return file >> value ? value : unknown;
    }
  return unknown;
}

double first_number_in(const std::string& path) {
  std::ifstream file(path);
  double value = 0;
  return file >> value ? value : unknown;
}

double free_in_system() {
  return 1024 * number_in("/proc/meminfo", "MemAvailable:");
}

/// What a control group counts as used includes files that the system would give up.
double free_in_group(const std::string& limit, const std::string& usage, const char* statistics, const char* files) {
  const double most = first_number_in(limit), used = first_number_in(usage);
  if (most == unknown || used == unknown) return unknown;
  const double given_up = number_in(statistics, files);
  return most - used + (given_up == unknown ? 0 : given_up);
}

double free_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  const double pages = first_number_in("/proc/self/statm");
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double seconds_of(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

std::optional<double> available_memory() {
  const double least = std::min(
      {free_in_system(),
       free_in_group("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current", "/sys/fs/cgroup/memory.stat",
                     "inactive_file"),
       free_in_group("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes",
                     "/sys/fs/cgroup/memory/memory.stat", "total_inactive_file"),
       free_address_space()});
  if (least == unknown) return std::nullopt;
  return std::max(least, 0.0);
}

std::optional<double> available_disk(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::path above = std::filesystem::absolute(folder, failed);
  while (!failed && !std::filesystem::exists(above, failed) && above.has_relative_path()) above = above.parent_path();
  const std::filesystem::space_info space = std::filesystem::space(above, failed);
  if (failed) return std::nullopt;
  return static_cast<double>(space.available);
}

namespace {

std::string search_path() {
  if (const char* path = std::getenv("PATH")) return path;
  std::string path(confstr(_CS_PATH, nullptr, 0), '\0');  // POSIX: where the standard utilities are
  confstr(_CS_PATH, path.data(), path.size());
  return path.c_str();
}

}  // namespace

double processor_seconds() {
  return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

double processor_seconds_of_thread() {
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

int processors() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

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
