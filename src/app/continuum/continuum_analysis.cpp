// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_analysis.hpp"

#include <cmath>
#include <deque>

#include "analysis/discharge.hpp"
#include "analysis/hopper_air.hpp"
#include "analysis/hopper_quantities.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"
#include "io/vtkhdf_grid.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::app {

namespace {

constexpr double time_of_mean_speed = 20e-3;  // s, estimator.quiescent_speed

/// Of earlier snapshots, rising in time, the one whose time is nearest to `at`; null if there is none.
const PointSet* nearest_to(const std::deque<PointSet>& earlier, double at) {
  const PointSet* nearest = nullptr;
  for (const PointSet& points : earlier)
    if (!nearest || std::abs(points.time - at) < std::abs(nearest->time - at)) nearest = &points;
  return nearest;
}

/// The snapshot of the air taken with one of the particles.
std::filesystem::path air_beside(const std::filesystem::path& particles) {
  std::string name = particles.filename();
  return particles.parent_path() / name.replace(0, name.find('_'), "air");
}

void write_table(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns,
                 const std::vector<std::vector<double>>& rows) {
  SeriesWriter table(path, columns);
  for (const auto& row : rows) table.append(row);
}

void write_snapshots(const std::filesystem::path& path, const HopperRun& run) {
  std::vector<SeriesColumn> columns;
  std::vector<std::vector<double>> rows;
  for (const auto& entry : hopper_frame_numbers) columns.push_back({std::string(entry.name), std::string(entry.unit)});
  for (const HopperFrame& frame : run.frames) {
    rows.emplace_back();
    for (const auto& entry : hopper_frame_numbers) rows.back().push_back(frame.*entry.number);
  }
  write_table(path, columns, rows);
}

void write_discharge(const std::filesystem::path& path, const HopperRun& run) {
  const Curve rate = mean_rates(passed_mass(run), 20e-3, 5e-3, 0, run.end());
  std::vector<std::vector<double>> rows;
  for (std::size_t n = 0; n < rate.time.size(); ++n) rows.push_back({rate.time[n], rate.value[n]});
  write_table(path, {{"time", "s"}, {"discharge_rate", "kg/s"}}, rows);
}

void write_surfaces(const std::filesystem::path& path, const HopperRun& run, const Snapshot& last) {
  const HopperSurfaces surfaces = hopper_view(last, run.setting, last.time >= run.gate_time).surfaces;
  std::vector<std::vector<double>> rows;
  for (std::size_t n = 0; n < surfaces.bin.x.size(); ++n)
    rows.push_back(
        {surfaces.bin.x[n], surfaces.bin.z[n], surfaces.hopper.z.empty() ? HopperFrame::none : surfaces.hopper.z[n]});
  write_table(path, {{"x", "m"}, {"bin_surface", "m"}, {"hopper_surface", "m"}}, rows);
}

}  // namespace

HopperSetting hopper_setting(const continuum::Parameters& p) {
  const continuum::Lattice lattice = continuum::lattice_of(p);
  HopperSetting setting{.shape = {.width = p.box.width,
                                  .depth = p.box.depth,
                                  .height = p.box.height,
                                  .plate = {},
                                  .spacing = p.bed.spacing},
                        .domain = continuum::domain_of(p),
                        .particle_mass = lattice.mass,
                        .particles = static_cast<double>(continuum::bed_positions(p).size()),
                        .grain_density = p.grains.density,
                        .grain_diameter = p.grains.diameter,
                        .gravity = p.gravity.acceleration,
                        .smoothing_length = {},
                        .air = p.air.enabled,
                        .stress_share = p.sph.stress_form == sph::StressForm::printed ? p.bed.packing : 1.0};
  if (const auto outlet = continuum::outlet_of(p))
    setting.shape.plate = {outlet->height, outlet->left, outlet->right};
  else if (p.plate.height)
    setting.shape.plate = {*p.plate.height, p.plate.slit_left.value_or(0.5 * p.box.width),
                           p.plate.slit_right.value_or(0.5 * p.box.width)};
  if (p.sph.smoothing == continuum::Smoothing::fixed)
    setting.smoothing_length = sph::smoothing_length(lattice.mass, p.bed.packing * p.grains.density);
  return setting;
}

std::vector<std::filesystem::path> particle_snapshots(const std::filesystem::path& run_folder) {
  const RunFolder folder(run_folder);
  std::vector<std::filesystem::path> paths;
  for (const int number : folder.snapshot_numbers()) paths.push_back(folder.snapshot(number));
  return paths;
}

HopperRun read_hopper(const std::filesystem::path& run_folder, const HopperSetting& setting) {
  HopperRun run{.setting = setting, .series = read_series(RunFolder(run_folder).series())};
  if (run.series.rows() == 0) throw FileError((run_folder / "series.csv").string(), "has no rows");
  run.gate_time = gate_time_of(run.series);
  std::deque<PointSet> earlier;
  for (const auto& path : particle_snapshots(run_folder)) {
    PointSet points = read_points(path);
    const double then = points.time - time_of_mean_speed;
    while (earlier.size() > 1 && earlier[1].time <= then) earlier.pop_front();
    const PointSet* before = nearest_to(earlier, then);
    const Snapshot earlier_view = before ? before->view() : Snapshot{};
    HopperFrame frame = hopper_frame(points.view(), before ? &earlier_view : nullptr, setting, run.gate_time);
    if (const auto air = air_beside(path); std::filesystem::exists(air)) measure_air(frame, read_grid(air), setting);
    run.frames.push_back(frame);
    earlier.push_back(std::move(points));
  }
  return run;
}

std::vector<NamedValue> analyze_continuum(const std::filesystem::path& run_folder, const HopperSetting& setting) {
  const HopperRun run = read_hopper(run_folder, setting);
  const std::filesystem::path folder = run_folder / "analysis";
  std::filesystem::create_directories(folder);
  write_snapshots(folder / "snapshots.csv", run);
  if (setting.shape.plate) write_discharge(folder / "discharge.csv", run);
  if (const auto paths = particle_snapshots(run_folder); !paths.empty()) {
    const PointSet last = read_points(paths.back());
    write_surfaces(folder / "surfaces.csv", run, last.view());
  }
  return hopper_summary(run);
}

}  // namespace talus::app
