// SPDX-License-Identifier: Apache-2.0
#include "app/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/discharge.hpp"
#include "analysis/wall_loads.hpp"
#include "io/file_list.hpp"
#include "io/report_page.hpp"
#include "io/series.hpp"

namespace talus::app {

namespace {

constexpr std::size_t max_rows = 2000;

/// The least and the largest of a stretch, in the order in which they came; nan where there is no number.
std::pair<double, double> ends_of(const std::vector<double>& values, std::size_t from, std::size_t to) {
  std::size_t least = to, largest = to;
  for (std::size_t n = from; n < to; ++n) {
    if (!std::isfinite(values[n])) continue;
    if (least == to || values[n] < values[least]) least = n;
    if (largest == to || values[n] > values[largest]) largest = n;
  }
  if (least == to) return {std::nan(""), std::nan("")};
  return least <= largest ? std::pair{values[least], values[largest]} : std::pair{values[largest], values[least]};
}

}  // namespace

Series thinned(const Series& table, std::size_t most) {
  const std::size_t rows = table.rows(), stretches = most / 2;
  if (rows <= most || stretches == 0) return table;
  Series thin{.names = table.names, .units = table.units, .columns = {}};
  thin.columns.resize(table.columns.size());
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t from = s * rows / stretches, to = (s + 1) * rows / stretches;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::vector<double>& values = table.columns[c];
      const auto [first, second] =
          c == 0 ? std::pair{values[from], values[(from + to) / 2]} : ends_of(values, from, to);
      thin.columns[c].push_back(first);
      thin.columns[c].push_back(second);
    }
  }
  return thin;
}

Series forces_on_walls(const Series& series) {
  constexpr double windows = 100;
  Series forces;
  if (series.rows() < 3) return forces;
  const std::span<const double> time = series.column("time");
  const double length = (time.back() - time.front()) / windows;
  for (const std::string& wall : walls_of(series))
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string column = "impulse_" + wall + '_' + axis;
      if (!series.has(column)) continue;
      const std::span<const double> impulse = series.column(column);
      const Curve force = mean_rates({{time.begin(), time.end()}, {impulse.begin(), impulse.end()}}, length,
                                     0.5 * length, time.front(), time.back());
      if (std::all_of(force.value.begin(), force.value.end(), [](double f) { return f == 0 || std::isnan(f); }))
        continue;
      if (forces.columns.empty()) {
        forces.names.emplace_back("time");
        forces.units.emplace_back("s");
        forces.columns.push_back(force.time);
      }
      forces.names.push_back("force_" + wall + '_' + axis);
      forces.units.emplace_back("N");
      forces.columns.push_back(force.value);
    }
  return forces;
}

std::vector<std::filesystem::path> files_of_run(const std::filesystem::path& folder, const std::string& part,
                                                const std::string& ending) {
  std::vector<std::filesystem::path> paths;
  if (!std::filesystem::exists(folder / part)) return paths;
  const std::optional<FileList> list = FileList::read(folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder / part))
    if (entry.path().extension() == ending && (!list || list->holds(part + "/" + entry.path().filename().string())))
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

nlohmann::ordered_json pack_table(const std::string& name, const Series& table, double origin,
                                  std::vector<std::string>& blocks) {
  Series thin = thinned(table, max_rows);
  nlohmann::ordered_json json{{"name", name}, {"rows", thin.rows()}, {"of_rows", table.rows()}};
  for (double& t : thin.columns.front()) t -= origin;
  json["columns"] = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < thin.columns.size(); ++c) {
    const auto& values = thin.columns[c];
    if (std::none_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) continue;
    json["columns"].push_back({{"name", thin.names[c]}, {"unit", thin.units[c]}, {"block", blocks.size()}});
    blocks.push_back(pack_numbers(values));
  }
  return json;
}

nlohmann::ordered_json pack_tables(const std::filesystem::path& folder, const Series& series, double origin,
                                   std::vector<std::string>& blocks) {
  auto tables = nlohmann::ordered_json::array();
  for (const auto& path : files_of_run(folder, "analysis", ".csv"))
    if (const Series table = read_series(path); table.rows() > 0 && table.names.front() == "time")
      tables.push_back(pack_table(path.stem().string(), table, 0, blocks));
  if (const Series forces = forces_on_walls(series); forces.rows() > 0)
    tables.push_back(pack_table("forces", forces, origin, blocks));
  if (series.rows() > 0) tables.push_back(pack_table("series", series, origin, blocks));
  return tables;
}

}  // namespace talus::app
