// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/avalanche_quantities.hpp"
#include "analysis/falling_cloud.hpp"
#include "analysis/quantities.hpp"
#include "base/error.hpp"
#include "io/file_list.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

/// The front's place against time. From the side it is there once grains have reached the slope.
Curve front_of(const Series& series, const CloudFrame& frame) {
  const auto time = series.column("time");
  const auto place = series.column(frame.motion == cloud::Motion::xz ? "front_on_slope_x" : "front_x");
  Curve front;
  for (std::size_t n = 0; n < time.size(); ++n) {
    if (!std::isfinite(place[n])) continue;
    front.time.push_back(time[n]);
    front.value.push_back(place[n]);
  }
  return front;
}

std::vector<Vector3> seen_from_the_side(std::span<const Vector3> position) {
  std::vector<Vector3> projected(position.begin(), position.end());
  for (Vector3& x : projected) x.y = 0;
  return projected;
}

/// Fall speed, leakage and shape of a cloud in free space, and what the summary says of them.
std::vector<NamedValue> analyze_falling_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame) {
  std::vector<std::vector<double>> rows;
  double radius = 0;
  for (const auto& path : snapshot_paths(run_folder)) {
    const PointSet points = read_points(path);
    const Snapshot view = points.view();
    if (rows.empty()) {
      Vector3 centre;
      for (const Vector3& x : view.positions()) centre += (1.0 / static_cast<double>(view.size())) * x;
      for (const Vector3& x : view.positions()) radius = std::max(radius, norm(x - centre));
    }
    const FallingCloud c = measure_falling_cloud(view.positions(), view.vectors("velocity"), frame.gravity, radius);
    rows.push_back({view.time / frame.scales.time(), c.fall_speed / frame.scales.stokes_speed, c.leaked_fraction,
                    c.axial_density, c.flatness});
  }
  if (rows.empty()) return {};
  write_table(
      run_folder / "analysis" / "snapshots.csv",
      {{"time", "a/v_s"}, {"fall_speed", "v_s"}, {"leaked_fraction", "1"}, {"axial_density", "1"}, {"flatness", "1"}},
      rows);
  return {{"fall_speed_start", "1", rows.front()[1]},
          {"fall_speed_end", "1", rows.back()[1]},
          {"leaked_fraction", "1", rows.back()[2]},
          {"axial_density", "1", rows.back()[3]},
          {"flatness", "1", rows.back()[4]}};
}

std::string unit_in_table(std::string_view name) {
  if (name == "time") return "a/v_s";
  const QuantityDefinition* quantity = find_quantity(name);
  return quantity ? std::string(quantity->unit) : "1";
}

}  // namespace

std::vector<std::filesystem::path> snapshot_paths(const std::filesystem::path& run_folder) {
  const RunFolder folder(run_folder);
  std::vector<std::filesystem::path> paths;
  for (const int number : folder.snapshot_numbers()) paths.push_back(folder.snapshot(number));
  return paths;
}

AvalancheRun read_avalanche(const std::filesystem::path& run_folder, const CloudFrame& frame) {
  const Series series = read_series(RunFolder(run_folder).series());
  const Curve front = front_of(series, frame);
  const auto overlap = series.column("overlap_max");
  if (overlap.empty()) throw FileError(RunFolder(run_folder).series().string(), "holds no row: the run has not begun");
  const double end = series.column("time").back();

  std::optional<AvalancheRun> run;
  PointSet first, last;
  for (const auto& path : snapshot_paths(run_folder)) {
    last = read_points(path);
    const Snapshot view = last.view();
    if (!run) {
      first = last;
      run =
          frame.has_slope ? avalanche_run(front, end, frame.scales, view.size()) : AvalancheRun{.scales = frame.scales};
    }
    if (!frame.has_slope) continue;
    const std::vector<Vector3> projected =
        frame.motion == cloud::Motion::xyz ? seen_from_the_side(view.positions()) : std::vector<Vector3>{};
    run->frames.push_back(avalanche_frame({.time = view.time,
                                           .position = projected.empty() ? view.positions() : std::span(projected),
                                           .radius = view.scalars("radius"),
                                           .velocity = view.vectors("velocity")},
                                          front, frame.scales, frame.view()));
  }
  if (!run) run = AvalancheRun{.scales = frame.scales};
  if (frame.has_slope) set_displacements(*run, first.view().positions(), last.view().positions());
  run->overlap_max = *std::max_element(overlap.begin(), overlap.end()) / frame.scales.mean_radius;
  return *run;
}

std::vector<NamedValue> analyze_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame) {
  const AvalancheRun run = read_avalanche(run_folder, frame);
  const std::filesystem::path folder = run_folder / "analysis";
  make_folder(folder);
  if (!frame.has_slope) {
    std::vector<NamedValue> quantities;
    if (frame.motion == cloud::Motion::xyz) quantities = analyze_falling_cloud(run_folder, frame);
    quantities.push_back({"overlap_max", "1", run.overlap_max});
    return quantities;
  }
  std::vector<std::vector<double>> rows;
  for (std::size_t n = 0; n < run.front_speed.time.size(); ++n)
    rows.push_back({run.front_speed.time[n], run.front_speed.value[n]});
  write_table(folder / "front_speed.csv", {{"time", "a/v_s"}, {"front_speed", "v_s"}}, rows);

  std::vector<SeriesColumn> columns;
  for (const auto& [name, number] : avalanche_frame_numbers)
    columns.push_back({std::string(name), unit_in_table(name)});
  rows.clear();
  for (const AvalancheFrame& f : run.frames) {
    rows.emplace_back();
    for (const auto& [name, number] : avalanche_frame_numbers) rows.back().push_back(f.*number);
  }
  write_table(folder / "snapshots.csv", columns, rows);

  if (frame.view() == AvalancheView::from_above && !run.frames.empty()) {
    rows.clear();
    for (const double width : run.frames.back().head_widths) rows.push_back({width});
    write_table(folder / "head_widths.csv", {{"width", "m"}}, rows);
  }
  return avalanche_summary(run, frame.view());
}

}  // namespace talus::app
