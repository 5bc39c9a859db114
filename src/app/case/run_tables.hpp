// SPDX-License-Identifier: Apache-2.0
/// The tables in a run's folder `analysis`, and the snapshots that they are made from.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/measure.hpp"
#include "io/series.hpp"

namespace talus::app {

/// The particles' snapshots of a run, in the order of their numbers.
std::vector<std::filesystem::path> snapshot_paths(const std::filesystem::path& run_folder);

/// How many of the snapshots are kept in memory while they are measured: two at least.
/// \param bytes that they may take, about
std::size_t snapshots_in_memory(const std::vector<std::filesystem::path>& paths, std::size_t bytes);

/// The snapshots nearest to `count` times evenly spaced over the run from 0, when the gate opens, to its end, both
/// included; from the first snapshot of a run that ends before. Each once. \param time of the snapshots, rising, s
std::vector<std::size_t> chosen_snapshots(const std::vector<double>& time, std::size_t count);

using talus::write_table;
/// A row per point of the curve. \throws FileError
void write_table(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns, const Curve& curve);

/// A row per snapshot, a column per measure that is a number of a snapshot; without the columns that have no number in
/// any snapshot. \throws FileError
template <class Run>
void write_snapshots(const std::filesystem::path& path, const Run& run, std::span<const Measure<Run>> measures,
                     const std::string& time_unit) {
  std::vector<SeriesColumn> columns = {{"time", time_unit}};
  std::vector<std::vector<double>> rows;
  for (const double time : run.snapshots.time()) rows.push_back({time});
  const std::vector<Measure<Run>> numbers_of_snapshots = columns_of_snapshots(measures);
  for (std::size_t n = 0; n < rows.size(); ++n)  // all numbers of a snapshot while it is in memory; they are remembered
    for (const Measure<Run>& m : numbers_of_snapshots) run.snapshots.value(n, m.estimator.number);
  for (const Measure<Run>& m : numbers_of_snapshots) {
    const Curve numbers = run.snapshots.curve(m.estimator.number);
    if (std::all_of(numbers.value.begin(), numbers.value.end(), [](double v) { return std::isnan(v); })) continue;
    columns.push_back({std::string(m.name), std::string(m.unit)});
    for (std::size_t n = 0; n < rows.size(); ++n) rows[n].push_back(numbers.value[n]);
  }
  write_table(path, columns, rows);
}

}  // namespace talus::app
