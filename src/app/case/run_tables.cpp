// SPDX-License-Identifier: Apache-2.0
#include "app/case/run_tables.hpp"

#include <algorithm>

#include "io/run_folder.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

std::vector<std::filesystem::path> snapshot_paths(const std::filesystem::path& run_folder) {
  const RunFolder folder(run_folder);
  std::vector<std::filesystem::path> paths;
  for (const int number : folder.snapshot_numbers()) paths.push_back(folder.snapshot(number));
  return paths;
}

std::size_t snapshots_in_memory(const std::vector<std::filesystem::path>& paths, std::size_t bytes) {
  constexpr std::size_t unpacked = 2;  // of a snapshot in memory over its file, of a sector for each copy
  std::error_code none;
  const std::size_t size = paths.empty() ? 1
                                         : std::filesystem::file_size(paths.front(), none) *
                                               static_cast<std::size_t>(read_copies(paths.front()));
  return std::max<std::size_t>(2, bytes / (unpacked * std::max<std::size_t>(size, 1)));
}

std::vector<std::size_t> chosen_snapshots(const std::vector<double>& time, std::size_t count) {
  if (time.empty()) return {};
  const double end = time.back(), begin = end > 0 ? std::max(0.0, time.front()) : time.front();
  std::vector<std::size_t> chosen;
  for (std::size_t n = 0; n < count; ++n)
    chosen.push_back(
        nearest_point(time, begin + (end - begin) * static_cast<double>(n) / static_cast<double>(count - 1)));
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

void write_table(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns, const Curve& curve) {
  std::vector<std::vector<double>> rows;
  for (std::size_t n = 0; n < curve.time.size(); ++n) rows.push_back({curve.time[n], curve.value[n]});
  write_table(path, columns, rows);
}

}  // namespace talus::app
