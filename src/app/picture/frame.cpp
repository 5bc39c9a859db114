// SPDX-License-Identifier: Apache-2.0
#include "app/picture/frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/curve.hpp"
#include "analysis/hopper.hpp"
#include "app/case/scene.hpp"
#include "app/models/models.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

const std::string of_air = "air.";

/// An error that lists what there is.
[[noreturn]] void throw_unknown(const std::string& option, const std::filesystem::path& file,
                                const std::vector<std::string>& names, const std::string& given) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  throw InputError({{.where = option + " " + given,
                     .what = fmt::format("{} has no such field", file.string()),
                     .allowed = names.empty() ? "nothing: there is none" : fmt::format("{}", fmt::join(names, ", ")),
                     .nearest = std::string(nearest(given, views))}});
}

/// The cells' positions in the middle of the depth, and their numbers in a column.
struct Layer {
  std::vector<std::size_t> cells;
  std::vector<Vector3> centres;

  explicit Layer(const GridSnapshot& air) {
    const int j = air.count[1] / 2;
    for (int k = 0; k < air.count[2]; ++k)
      for (int i = 0; i < air.count[0]; ++i) {
        cells.push_back(air.index(i, j, k));
        centres.push_back(air.centre(i, j, k));
      }
  }
};

/// Fills positions, radii and values with the cells of the air. \param name without "air."
void show_cells(const GridSnapshot& air, const std::string& name, const std::filesystem::path& file, Frame& frame) {
  const Layer layer(air);
  frame.positions = layer.centres;
  frame.radii.assign(layer.cells.size(), 0.75 * std::max(air.spacing.x, air.spacing.z));  // without gaps
  std::vector<std::string> names;
  for (const GridSnapshot::Column& column : air.columns) {
    const auto take = [&](const std::string& of, const auto& value) {
      names.push_back(of_air + of);
      if (of != name) return;
      frame.unit = column.unit;
      for (const std::size_t cell : layer.cells) frame.values.push_back(value(cell));
    };
    if (const auto* scalars = std::get_if<std::vector<double>>(&column.values))
      take(column.name, [&](std::size_t n) { return (*scalars)[n]; });
    if (const auto* vectors = std::get_if<std::vector<Vector3>>(&column.values)) {
      take(column.name, [&](std::size_t n) { return norm((*vectors)[n]); });
      for (int axis = 0; axis < 3; ++axis)
        take(column.name + '_' + "xyz"[axis], [&](std::size_t n) { return (*vectors)[n][axis]; });
    }
  }
  if (frame.values.empty()) throw_unknown("--color", file, names, of_air + name);
}

void show_particles(const Snapshot& snapshot, double radius, const std::string& name, const std::filesystem::path& file,
                    Frame& frame) {
  const auto positions = snapshot.positions();
  frame.positions.assign(positions.begin(), positions.end());
  frame.radii.assign(positions.size(), radius);
  if (snapshot.has("radius")) {
    const auto radii = snapshot.scalars("radius");
    frame.radii.assign(radii.begin(), radii.end());
  }
  const MassRatios ratios = snapshot.mass_ratios();
  for (std::size_t i = 0; i < ratios.of.size(); ++i) frame.radii[i] *= std::cbrt(ratios[i]);
  if (name.empty()) return;
  std::vector<std::string> names;
  bool found = false;
  for_each_number(snapshot, [&](const std::string& of, const std::string& unit, const auto& value) {
    names.push_back(of);
    if (of != name) return;
    found = true;
    frame.unit = unit;
    for (std::size_t n = 0; n < positions.size(); ++n) frame.values.push_back(value(n));
  });
  if (!found) throw_unknown("--color", file, names, name);
}

void show_arrows(const Snapshot& snapshot, const std::string& name, const std::filesystem::path& file, Frame& frame) {
  std::vector<std::string> names;
  for (const ColumnView& column : snapshot.columns) {
    const auto* vectors = std::get_if<std::span<const Vector3>>(&column.values);
    if (!vectors || column.name == "position") continue;
    names.emplace_back(column.name);
    if (column.name != name) continue;
    frame.arrow_values.assign(vectors->begin(), vectors->end());
    frame.arrow_positions = frame.positions;
    frame.arrow_unit = column.unit;
    return;
  }
  names.emplace_back("air");
  throw_unknown("--arrows", file, names, name);
}

}  // namespace

RunFrames::RunFrames(const std::filesystem::path& path) : folder_(path) {
  const RunFolder folder(path);
  if (!std::filesystem::exists(folder.manifest()))
    throw FileError(path.string(), "is not a Talus run folder (manifest.json missing)");
  scene_ = open_run(path)->scene();
  numbers_ = folder.snapshot_numbers();
  has_particles_ = !numbers_.empty();
  if (!has_particles_) numbers_ = folder.snapshot_numbers("air");
  if (numbers_.empty()) throw FileError(path.string(), "holds no snapshots");
  const Series series = read_series(folder.series());
  if (series.has("gate_time") && series.rows() > 0) origin_ = gate_time_of(series);
  for (const int number : numbers_)
    times_.push_back(read_points_time(folder.snapshot(number, has_particles_ ? "particles" : "air")) - origin_);
}

std::size_t RunFrames::at(double time, const std::string& option) const {
  const std::size_t found = nearest_point(times_, time);
  const double apart =
      times_.size() < 2 ? 0 : (times_.back() - times_.front()) / static_cast<double>(times_.size() - 1);
  if (std::abs(times_[found] - time) <= 0.5 * apart + 1e-9 || (time >= times_.front() && time <= times_.back()))
    return found;
  std::vector<std::string> all;
  for (const double t : times_) all.push_back(fmt::format("{:.4g}", t));
  constexpr std::size_t most = 24;
  throw InputError(
      {{.where = option,
        .what = fmt::format("{} has no snapshot near {:g} s", folder_.string(), time),
        .allowed = all.size() <= most ? fmt::format("{} (s)", fmt::join(all, ", "))
                                      : fmt::format("{} to {} s, {} snapshots", all.front(), all.back(), all.size())}});
}

Frame RunFrames::read(std::size_t snapshot, const Shown& shown) const {
  const RunFolder folder(folder_);
  Frame frame{.time = times_[snapshot]};
  const std::filesystem::path points_path = folder.snapshot(numbers_[snapshot]),
                              air_path = folder.snapshot(numbers_[snapshot], "air");
  const bool cells = shown.color.starts_with(of_air);
  std::optional<PointSet> points;
  if (has_particles_ && (!cells || (!shown.arrows.empty() && shown.arrows != "air"))) points = read_points(points_path);
  std::optional<GridSnapshot> air;
  if (cells || shown.arrows == "air") {
    if (!std::filesystem::exists(air_path))
      throw InputError({{.where = cells ? "--color " + shown.color : "--arrows air",
                         .what = fmt::format("{} has no air", folder_.string()),
                         .allowed = "a run of a case with air.enabled = true"}});
    air = read_grid(air_path);
  }
  if (cells)
    show_cells(*air, shown.color.substr(of_air.size()), air_path, frame);
  else if (points)
    show_particles(points->view(), scene_.radius, shown.color, points_path, frame);
  else
    throw InputError({{.where = "--color " + shown.color,
                       .what = fmt::format("{} has no particles", folder_.string()),
                       .allowed = "air.velocity, air.pressure: a field of the air"}});
  if (air && shown.arrows == "air") {
    const Layer layer(*air);
    frame.arrow_positions = layer.centres;
    for (const std::size_t cell : layer.cells) frame.arrow_values.push_back(air->vectors("velocity")[cell]);
    frame.arrow_unit = "m/s";
  } else if (!shown.arrows.empty() && points) {
    Frame of_points{.positions = {points->view().positions().begin(), points->view().positions().end()}};
    show_arrows(points->view(), shown.arrows, points_path, of_points);
    frame.arrow_positions = std::move(of_points.arrow_positions);
    frame.arrow_values = std::move(of_points.arrow_values);
    frame.arrow_unit = of_points.arrow_unit;
  }
  return frame;
}

}  // namespace talus::app
