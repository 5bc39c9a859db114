// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/case/run_tables.hpp"
#include "base/error.hpp"
#include "io/file_list.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

/// The front's position against time. From the side it is there once grains have reached the slope.
Curve front_of(const Series& series, const CloudFrame& frame) {
  const auto time = series.column("time");
  const auto position = series.column(frame.motion == cloud::Motion::xz ? "front_on_slope_x" : "front_x");
  Curve front;
  for (std::size_t n = 0; n < time.size(); ++n) {
    if (!std::isfinite(position[n])) continue;
    front.time.push_back(time[n]);
    front.value.push_back(position[n]);
  }
  return front;
}

/// Of the points about their centre.
double radius_of(std::span<const Vector3> positions) {
  Vector3 centre;
  for (const Vector3& x : positions) centre += (1.0 / static_cast<double>(positions.size())) * x;
  double radius = 0;
  for (const Vector3& x : positions) radius = std::max(radius, norm(x - centre));
  return radius;
}

}  // namespace

AvalancheRun read_avalanche(const std::filesystem::path& run_folder, const CloudFrame& frame) {
  const Series series = read_series(RunFolder(run_folder).series());
  const Curve front = front_of(series, frame);
  const auto overlap = series.column("overlap_max");
  if (overlap.empty()) throw FileError(RunFolder(run_folder).series().string(), "holds no row: the run has not begun");
  const double end = series.column("time").back();

  AvalancheRun run = avalanche_run(frame.has_slope ? front : Curve{}, end, frame.scales);
  run.motion = frame.cloud_motion();
  run.overlap_max = *std::max_element(overlap.begin(), overlap.end()) / frame.scales.mean_radius;
  if (run.motion != CloudMotion::falling) return run;
  const auto paths = snapshot_paths(run_folder);
  const double initial_radius = paths.empty() ? 0 : radius_of(read_points(paths.front()).view().positions());
  std::vector<double> time;
  for (const auto& path : paths) time.push_back(read_points_time(path) / frame.scales.time());
  const auto read = [=](std::size_t n) {
    const PointSet points = read_points(paths[n]);
    const Snapshot now = points.view();
    return std::make_shared<const FallSnapshot>(
        FallSnapshot{measure_falling_cloud(now.positions(), now.vectors("velocity"), frame.gravity, initial_radius),
                     frame.scales.stokes_speed});
  };
  run.snapshots = AvalancheRun::Numbers::of(std::move(time), read, paths.size());
  return run;
}

std::vector<NamedValue> analyze_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame,
                                      const AvalancheRun& run) {
  const std::filesystem::path folder = run_folder / "analysis";
  make_folder(folder);
  if (run.motion == CloudMotion::falling) write_snapshots(folder / "snapshots.csv", run, avalanche_measures(), "a/v_s");
  if (frame.has_slope)
    write_table(folder / "front_speed.csv", {{"time", "a/v_s"}, {"front_speed", "v_s"}}, run.front_speed);
  return summary_of(run, avalanche_measures());
}

}  // namespace talus::app
