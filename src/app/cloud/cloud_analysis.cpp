// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/displacement.hpp"
#include "analysis/frontal_angle.hpp"
#include "analysis/fronts.hpp"
#include "analysis/head_tail.hpp"
#include "analysis/heads.hpp"
#include "analysis/statistics.hpp"
#include "analysis/vortices.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

const double nan = std::nan("");

// The aspect ratio and the largest head are judged after the early stage (table of the avalanche paper, row 5).
constexpr double early_stage = 6;

std::vector<NamedValue> measure_heads(const Snapshot& snapshot, const CloudFrame& frame, double front_speed) {
  const auto position = snapshot.positions();
  const auto radius = snapshot.scalars("radius");
  const std::vector<GrainSet> heads = find_heads(position, frame.radius);
  HeadSize size{.width = nan, .thickness = nan, .centre = nan, .foremost = nan, .inner = nan, .concavity = nan};
  HeadMotion motion{nan, nan, nan, nan};
  if (!heads.empty()) {
    size = head_size(position, radius, heads.front(), frame.radius);
    if (snapshot.has("velocity"))
      motion = head_motion(position, snapshot.vectors("velocity"), Links(position, HeadRule{}.reach * frame.radius),
                           heads.front(), size, front_speed * frame.stokes_speed);
  }
  const double v_s = frame.stokes_speed, a = frame.radius;
  return {{"head_count", "1", static_cast<double>(heads.size())},
          {"head_particles", "1", heads.empty() ? 0.0 : static_cast<double>(heads.front().size())},
          {"head_width", "a", size.width / a},
          {"head_thickness", "a", size.thickness / a},
          {"head_aspect_ratio", "1", size.aspect_ratio()},
          {"head_concavity", "1", size.concavity},
          {"head_curl_left", "v_s/a", motion.curl_left * a / v_s},
          {"head_curl_right", "v_s/a", motion.curl_right * a / v_s},
          {"head_rear_relative_velocity", "v_s", motion.rear_relative_velocity / v_s},
          {"head_front_outward_velocity", "v_s", motion.front_outward_velocity / v_s}};
}

std::vector<NamedValue> measure_head_and_tail(const Snapshot& snapshot, const CloudFrame& frame, double front_speed) {
  const auto position = snapshot.positions();
  const ThicknessProfile profile = thickness_profile(position, snapshot.scalars("radius"), frame.radius);
  HeadTailMotion motion{nan, nan, nan};
  if (snapshot.has("velocity"))
    motion = head_tail_motion(position, snapshot.vectors("velocity"), profile, front_speed * frame.stokes_speed);
  return {{"front_rear_thickness_ratio", "1", profile.head_thickness() / profile.rear_thickness()},
          {"head_upper_relative_velocity", "v_s", motion.upper_head / frame.stokes_speed},
          {"head_lower_relative_velocity", "v_s", motion.lower_head / frame.stokes_speed},
          {"tail_relative_velocity", "v_s", motion.tail / frame.stokes_speed}};
}

NamedValue measure_frontal_angle(const Snapshot& snapshot, const CloudFrame& frame) {
  const auto angle = angle_of_line(snapshot.positions(), surface_walk(snapshot.positions(), frame.radius));
  return {"frontal_angle", "deg", angle ? *angle * 180 / std::numbers::pi : nan};
}

void write_table(const std::filesystem::path& path, const std::vector<std::vector<NamedValue>>& rows) {
  if (rows.empty()) return;
  std::vector<SeriesColumn> columns;
  for (const NamedValue& value : rows.front()) columns.push_back({value.name, value.unit});
  SeriesWriter table(path, columns);
  for (const auto& row : rows) {
    std::vector<double> values;
    for (const NamedValue& value : row) values.push_back(value.value);
    table.append(values);
  }
}

std::vector<std::vector<NamedValue>> width_of_every_head(const Snapshot& snapshot, const CloudFrame& frame) {
  std::vector<std::vector<NamedValue>> rows;
  for (const GrainSet& head : find_heads(snapshot.positions(), frame.radius)) {
    const HeadSize size = head_size(snapshot.positions(), snapshot.scalars("radius"), head, frame.radius);
    rows.push_back({{"particles", "1", static_cast<double>(head.size())},
                    {"width", "m", size.width},
                    {"thickness", "m", size.thickness},
                    {"centre_y", "m", size.centre},
                    {"foremost_x", "m", size.foremost}});
  }
  return rows;
}

double value_of(const std::vector<NamedValue>& values, std::string_view name) {
  for (const NamedValue& value : values)
    if (value.name == name) return value.value;
  return nan;
}

/// The summary's quantities of the snapshots: of the last one, and the mean aspect ratio after the early stage.
void add_snapshot_quantities(std::vector<NamedValue>& quantities, const std::vector<std::vector<NamedValue>>& rows,
                             const CloudFrame& frame) {
  static constexpr std::string_view in_summary[] = {"head_count",     "head_particles", "head_width",
                                                    "head_thickness", "frontal_angle",  "front_rear_thickness_ratio"};
  for (const NamedValue& value : rows.back())
    if (std::find(std::begin(in_summary), std::end(in_summary), value.name) != std::end(in_summary))
      quantities.push_back(value);
  std::vector<double> ratios;
  for (const auto& row : rows)
    if (value_of(row, "time") > early_stage * frame.stokes_time())
      if (const double ratio = value_of(row, "head_aspect_ratio"); std::isfinite(ratio)) ratios.push_back(ratio);
  if (!ratios.empty()) quantities.push_back({"head_aspect_ratio", "1", mean(ratios)});
}

}  // namespace

std::vector<std::filesystem::path> snapshot_paths(const std::filesystem::path& run_folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(run_folder / "snapshots", none))
    if (entry.path().extension() == ".vtkhdf") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

Curve front_speed_of_run(const std::filesystem::path& run_folder, const CloudFrame& frame) {
  const Series series = read_series(run_folder / "series.csv");
  const auto time = series.column("time");
  const auto place = series.column(frame.motion == cloud::Motion::xz ? "front_on_slope_x" : "front_x");
  // A front on the slope is there once grains have reached it.
  Curve front;
  for (std::size_t n = 0; n < time.size(); ++n) {
    if (!std::isfinite(place[n])) continue;
    front.time.push_back(time[n] / frame.stokes_time());
    front.value.push_back(place[n] / frame.radius);
  }
  if (front.time.size() < 2 || front.time.back() < front.time.front() + front_speed_window) return {};
  return front_speed_curve(front, front_speed_window, front.time.back());
}

std::vector<NamedValue> measure_snapshot(const Snapshot& snapshot, const CloudFrame& frame, double front_speed) {
  std::vector<NamedValue> values = {{"time", "s", snapshot.time}, {"front_speed", "v_s", front_speed}};
  auto add = [&](std::vector<NamedValue> more) { values.insert(values.end(), more.begin(), more.end()); };
  if (!frame.has_slope) return values;
  if (frame.motion == cloud::Motion::xy) add(measure_heads(snapshot, frame, front_speed));
  if (frame.motion != cloud::Motion::xy) add(measure_head_and_tail(snapshot, frame, front_speed));
  if (frame.motion == cloud::Motion::xz) values.push_back(measure_frontal_angle(snapshot, frame));
  return values;
}

std::vector<NamedValue> analyze_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame) {
  std::filesystem::create_directories(run_folder / "analysis");
  std::vector<NamedValue> quantities;

  const Curve speed = front_speed_of_run(run_folder, frame);
  if (!speed.time.empty()) {
    std::vector<std::vector<NamedValue>> rows;
    for (std::size_t n = 0; n < speed.time.size(); ++n)
      rows.push_back({{"time", "a/v_s", speed.time[n]}, {"front_speed", "v_s", speed.value[n]}});
    write_table(run_folder / "analysis" / "front_speed.csv", rows);
    const Extremes e = extremes(speed);
    quantities = {{"front_speed_max", "v_s", e.largest},
                  {"front_speed_min", "v_s", e.least},
                  {"front_speed_end", "v_s", speed.value.back()}};
  }

  std::vector<std::vector<NamedValue>> rows;
  PointSet first, last;
  for (const auto& path : snapshot_paths(run_folder)) {
    last = read_points(path);
    if (rows.empty()) first = last;
    const double t = last.time / frame.stokes_time();
    const bool known = !speed.time.empty() && t >= speed.time.front() && t <= speed.time.back();
    rows.push_back(measure_snapshot(last.view(), frame, known ? value_at(speed, t) : nan));
  }
  if (!rows.empty()) {
    write_table(run_folder / "analysis" / "snapshots.csv", rows);
    if (frame.has_slope && frame.motion == cloud::Motion::xy)
      write_table(run_folder / "analysis" / "head_widths.csv", width_of_every_head(last.view(), frame));
    add_snapshot_quantities(quantities, rows, frame);
    const DisplacementSpread spread = displacement_spread(first.view().positions(), last.view().positions());
    if (spread.mean > 0)
      quantities.insert(quantities.end(), {{"displacement_spread", "1", spread.along / spread.mean},
                                           {"displacement_lateral", "a", spread.lateral / frame.radius}});
  }

  const Series series = read_series(run_folder / "series.csv");
  const auto overlap = series.column("overlap_max");
  quantities.push_back({"overlap_max", "a", *std::max_element(overlap.begin(), overlap.end()) / frame.radius});
  return quantities;
}

}  // namespace talus::app
