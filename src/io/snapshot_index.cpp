// SPDX-License-Identifier: Apache-2.0
#include "io/snapshot_index.hpp"

#include <map>
#include <string>

#include "io/json.hpp"
#include "io/vtkhdf.hpp"

namespace talus {

namespace {

/// Times by file name; empty where there is no index, or none that can be understood: it is rebuilt then.
std::map<std::string, double> known_times(const std::filesystem::path& index) {
  std::map<std::string, double> times;
  if (!std::filesystem::exists(index)) return times;
  try {
    read_json(index, "an index of snapshots", [&](const Json& json) {
      for (const Json& file : json.at("files")) times[file.at("name")] = file.at("time");
    });
  } catch (const FileError&) {
    times.clear();
  }
  return times;
}

}  // namespace

void index_snapshots(const RunFolder& folder, int latest, std::string_view kind, KnownTimes known) {
  std::map<std::string, double> times;
  if (known == KnownTimes::of_index) times = known_times(folder.snapshot_index(kind));
  times.erase(folder.snapshot(latest, kind).filename());  // it has just been written, perhaps by a resumed run
  Json files = Json::array();
  for (const int number : folder.snapshot_numbers(kind)) {
    if (number > latest) break;  // left from before the run was resumed; they will be replaced
    const std::filesystem::path path = folder.snapshot(number, kind);
    const std::string name = path.filename();
    const auto time = times.find(name);
    files.push_back({{"name", name}, {"time", time == times.end() ? read_points_time(path) : time->second}});
  }
  write_json(folder.snapshot_index(kind), {{"file-series-version", "1.0"}, {"files", files}}, Flush::later);
}

}  // namespace talus
