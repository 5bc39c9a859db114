// SPDX-License-Identifier: Apache-2.0
#include "base/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>

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

}  // namespace talus
