// SPDX-License-Identifier: Apache-2.0
#include "app/ensemble/report_entries.hpp"

#include <algorithm>

#include "app/ensemble/schedule.hpp"
#include "app/ensemble/statistics.hpp"
#include "app/runs/run_case.hpp"
#include "base/error.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"

namespace talus::app {

namespace {

/// What a folder holds is what its manifest says, whatever the case from which it was planned.
EnsembleMember member_of(const std::filesystem::path& folder) {
  const Manifest manifest = read_manifest(RunFolder(folder).manifest());
  return {.seed = manifest.seed,
          .settings = {},
          .folder = folder,
          .fingerprint = manifest.fingerprint,
          .end = end_of(manifest)};
}

bool is_run(const std::filesystem::path& folder) {
  return std::filesystem::exists(RunFolder(folder).manifest()) && std::filesystem::exists(RunFolder(folder).summary());
}

}  // namespace

std::vector<ReportEntry> entries_of(const std::vector<EnsembleGroup>& groups) {
  std::vector<ReportEntry> entries;
  for (const EnsembleGroup& group : groups) {
    std::vector<std::filesystem::path> done;
    for (const EnsembleMember& member : group.members)
      if (is_done(member)) done.push_back(member.folder);
    if (done.empty()) continue;
    ReportEntry entry{.folder = done.front(), .name = group.name, .members = done.size()};
    if (done.size() > 1) {
      for (const std::string& table : time_tables(group))
        entry.bands.emplace_back(table, table_spread(group, std::filesystem::path("analysis") / (table + ".csv")));
      for (QuantitySpread& spread : quantity_spreads(group))
        entry.quantities.push_back({spread.name, spread.unit, std::move(spread.values)});
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<ReportEntry> entries_of_folder(const std::filesystem::path& folder) {
  if (is_run(folder)) return {entry_of_run(folder)};
  if (!std::filesystem::is_directory(folder)) throw FileError(folder.string(), "no such folder");
  std::vector<std::filesystem::path> runs;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_directory() && is_run(entry.path())) runs.push_back(entry.path());
  std::sort(runs.begin(), runs.end());
  std::vector<EnsembleGroup> groups;
  for (const auto& run : runs) {
    // A run of which nothing is random is a group of its own, FOLDER/GROUP; members are FOLDER/GROUP/seed_0001.
    const bool is_member = run.filename().string().starts_with("seed_");
    const std::string name = (is_member ? run.parent_path() : run).lexically_proximate(folder).string();
    if (groups.empty() || groups.back().name != name) groups.push_back({.name = name, .settings = {}, .members = {}});
    groups.back().members.push_back(member_of(run));
  }
  for (EnsembleGroup& group : groups)
    std::sort(group.members.begin(), group.members.end(),
              [](const EnsembleMember& a, const EnsembleMember& b) { return a.seed < b.seed; });
  std::vector<ReportEntry> entries = entries_of(groups);
  if (entries.empty())
    throw InputError({{.where = folder.string(),
                       .what = "holds no finished run",
                       .allowed = "the folder of a run, of an ensemble, or of reproduce"}});
  return entries;
}

}  // namespace talus::app
