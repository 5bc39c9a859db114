// SPDX-License-Identifier: Apache-2.0
#include "app/ensemble/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "analysis/statistics.hpp"
#include "app/ensemble/schedule.hpp"
#include "io/file.hpp"
#include "io/file_list.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "io/series.hpp"

namespace talus::app {

namespace {

constexpr std::array<std::string_view, 5> of_the_machine{"wall_seconds", "settle_wall_seconds", "cpu_seconds",
                                                         "peak_memory", "threads"};

std::vector<const EnsembleMember*> done_members(const EnsembleGroup& group) {
  std::vector<const EnsembleMember*> done;
  for (const EnsembleMember& member : group.members)
    if (is_done(member)) done.push_back(&member);
  return done;
}

bool tells_about_the_machine(const std::string& name) {
  return std::find(of_the_machine.begin(), of_the_machine.end(), name) != of_the_machine.end();
}

/// Of the members that have any row of it.
std::vector<Series> read_tables(const EnsembleGroup& group, const std::filesystem::path& table) {
  std::vector<Series> tables;
  for (const EnsembleMember* member : done_members(group))
    if (const auto path = member->folder / table; std::filesystem::exists(path))
      if (Series read = read_series(path); read.rows() > 0) tables.push_back(std::move(read));
  return tables;
}

/// The columns of all tables, in the order in which they first occur, with their units.
std::vector<SeriesColumn> columns_of(const std::vector<Series>& tables) {
  std::vector<SeriesColumn> columns;
  for (const Series& t : tables)
    for (std::size_t c = 0; c < t.names.size(); ++c)
      if (std::none_of(columns.begin(), columns.end(), [&](const auto& known) { return known.name == t.names[c]; }))
        columns.push_back({t.names[c], t.units[c]});
  return columns;
}

/// A row of one of the tables.
struct TableRow {
  std::size_t table, row;
  double time;
};

/// Rows of several tables that belong together: those of the same number where the tables are equally long, otherwise
/// those of the same time, to within half of the usual distance of two rows.
std::vector<std::vector<TableRow>> rows_together(const std::vector<Series>& tables) {
  std::vector<TableRow> all;
  std::vector<double> distances;
  bool equally_long = true;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const std::vector<double>& time = tables[t].columns.front();
    equally_long = equally_long && time.size() == tables.front().rows();
    for (std::size_t row = 0; row < time.size(); ++row) {
      all.push_back({t, row, time[row]});
      if (row > 0) distances.push_back(time[row] - time[row - 1]);
    }
  }
  std::vector<std::vector<TableRow>> together;
  if (equally_long) {
    together.resize(tables.empty() ? 0 : tables.front().rows());
    for (const TableRow& one : all) together[one.row].push_back(one);
    return together;
  }
  std::sort(distances.begin(), distances.end());
  const double near = distances.empty() ? 0 : 0.5 * distances[distances.size() / 2];
  std::stable_sort(all.begin(), all.end(), [](const TableRow& a, const TableRow& b) { return a.time < b.time; });
  for (const TableRow& one : all) {
    const auto of_same_table = [&](const TableRow& other) { return other.table == one.table; };
    if (together.empty() || !(one.time - together.back().front().time <= near) ||
        std::any_of(together.back().begin(), together.back().end(), of_same_table))
      together.emplace_back();
    together.back().push_back(one);
  }
  return together;
}

void write_series(const std::filesystem::path& path, const Series& series) {
  std::vector<SeriesColumn> columns;
  std::vector<std::vector<double>> rows(series.rows());
  for (std::size_t c = 0; c < series.names.size(); ++c) {
    columns.push_back({series.names[c], series.units[c]});
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(series.columns[c][row]);
  }
  write_table(path, columns, rows);
}

}  // namespace

std::vector<QuantitySpread> quantity_spreads(const EnsembleGroup& group) {
  std::vector<QuantitySpread> spreads;
  for (const EnsembleMember* member : done_members(group)) {
    for (const NamedValue& value : read_summary(RunFolder(member->folder).summary()).quantities) {
      if (tells_about_the_machine(value.name)) continue;
      auto found = std::find_if(spreads.begin(), spreads.end(), [&](const auto& s) { return s.name == value.name; });
      if (found == spreads.end()) found = spreads.insert(spreads.end(), {value.name, value.unit, {}, 0, 0});
      if (std::isfinite(value.value)) found->values.push_back(value.value);
    }
  }
  for (QuantitySpread& spread : spreads) {
    spread.mean = mean(spread.values);
    spread.deviation = standard_deviation(spread.values);
  }
  return spreads;
}

Series table_spread(const EnsembleGroup& group, const std::filesystem::path& table) {
  const std::vector<Series> tables = read_tables(group, table);
  const std::vector<std::vector<TableRow>> rows = rows_together(tables);
  Series bands;
  for (const SeriesColumn& column : columns_of(tables)) {
    const bool is_time = bands.names.empty();
    std::vector<double> means, deviations;
    for (const std::vector<TableRow>& together : rows) {
      std::vector<double> values;
      for (const TableRow& one : together)
        if (const Series& t = tables[one.table]; t.has(column.name))
          if (const double v = t.column(column.name)[one.row]; std::isfinite(v)) values.push_back(v);
      means.push_back(mean(values));
      deviations.push_back(standard_deviation(values));
    }
    bands.names.push_back(is_time ? column.name : column.name + "_mean");
    bands.units.push_back(column.unit);
    bands.columns.push_back(std::move(means));
    if (is_time) continue;
    bands.names.push_back(column.name + "_deviation");
    bands.units.push_back(column.unit);
    bands.columns.push_back(std::move(deviations));
  }
  return bands;
}

std::vector<std::string> time_tables(const EnsembleGroup& group) {
  std::set<std::string> names;
  for (const EnsembleMember* member : done_members(group)) {
    const std::filesystem::path tables = member->folder / "analysis";
    if (!std::filesystem::exists(tables)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(tables))
      if (entry.path().extension() == ".csv")
        if (const Series table = read_series(entry.path()); table.rows() > 0 && table.names.front() == "time")
          names.insert(entry.path().stem().string());
  }
  return {names.begin(), names.end()};
}

void write_group(const EnsembleGroup& group, const std::filesystem::path& folder) {
  const std::vector<QuantitySpread> spreads = quantity_spreads(group);
  std::string members = "seed,status";
  for (const QuantitySpread& spread : spreads) members += fmt::format(",{} [{}]", spread.name, spread.unit);
  for (const EnsembleMember& member : group.members) {
    const bool done = is_done(member);
    members += fmt::format("\n{},{}", member.seed, done ? "done" : "not done");
    if (!done) continue;
    const Summary summary = read_summary(RunFolder(member.folder).summary());
    for (const QuantitySpread& spread : spreads) {
      const auto* value = summary.find(spread.name);
      members += value ? fmt::format(",{}", value->value) : ",nan";
    }
  }
  write_atomically(folder / "members.csv", members + "\n");

  std::string quantities = "quantity,unit,members,mean,standard_deviation,least,largest";
  for (const QuantitySpread& spread : spreads) {
    const auto [low, high] = std::minmax_element(spread.values.begin(), spread.values.end());
    quantities += fmt::format("\n{},{},{},{},{},{},{}", spread.name, spread.unit, spread.values.size(), spread.mean,
                              spread.deviation, spread.values.empty() ? std::nan("") : *low,
                              spread.values.empty() ? std::nan("") : *high);
  }
  write_atomically(folder / "quantities.csv", quantities + "\n");

  for (const std::string& table : time_tables(group))
    write_series(folder / ("bands_" + table + ".csv"),
                 table_spread(group, std::filesystem::path("analysis") / (table + ".csv")));
}

void claim_pictures(const EnsembleGroup& group, const std::filesystem::path& folder) {
  make_folder(folder / "pictures");
  for (const std::string& table : time_tables(group)) claim_file(folder / "pictures" / ("bands_" + table + ".png"));
  claim_file(folder / "pictures" / "histograms.png");
}

}  // namespace talus::app
