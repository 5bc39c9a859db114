// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_analysis.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "analysis/discharge.hpp"
#include "analysis/hopper_estimators.hpp"
#include "analysis/residence.hpp"
#include "app/case/run_tables.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "app/continuum/wall_loads.hpp"
#include "io/file_list.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"
#include "numerics/run_record.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::app {

namespace {

/// Of the snapshots before the n-th, the one whose time is nearest to so much before; nothing if there is none.
std::optional<std::size_t> earlier(const std::vector<double>& time, std::size_t n, double before) {
  if (n == 0) return std::nullopt;
  return nearest_point(std::span(time).first(n), time[n] - before);
}

/// Reads snapshots when they are asked for; one that is in use is not read again.
class Reader {
 public:
  Reader(std::vector<std::filesystem::path> paths, std::vector<double> time, HopperSetting setting, double gate_time)
      : paths_(std::move(paths)), time_(std::move(time)), setting_(std::move(setting)), gate_time_(gate_time) {}

  std::shared_ptr<const HopperSnapshot> read(std::size_t n) {
    auto loaded = std::make_shared<Loaded>(setting_, points(n), gate_time_);
    Loaded* kept = loaded.get();
    kept->snapshot.before = [this, kept, n]() -> const Snapshot* {
      const auto before = earlier(time_, n, setting_.averaging_time);
      if (before && !kept->before) {
        kept->before = points(*before);
        kept->earlier = kept->before->view();
      }
      return before ? &kept->earlier : nullptr;
    };
    return {loaded, &loaded->snapshot};
  }

 private:
  struct Loaded {
    Loaded(const HopperSetting& setting, std::shared_ptr<const PointSet> read, double gate_time)
        : now(std::move(read)), snapshot(setting, now->view(), gate_time) {}
    std::shared_ptr<const PointSet> now, before;
    Snapshot earlier;
    HopperSnapshot snapshot;
  };

  std::shared_ptr<const PointSet> points(std::size_t n) {
    std::shared_ptr<const PointSet> found = in_use_[n].lock();
    if (!found) in_use_[n] = found = std::make_shared<PointSet>(read_points(paths_[n]));
    return found;
  }

  std::vector<std::filesystem::path> paths_;
  std::vector<double> time_;
  HopperSetting setting_;
  double gate_time_;
  std::map<std::size_t, std::weak_ptr<const PointSet>> in_use_;
};

void write_surfaces(const std::filesystem::path& path, const HopperSurfaces& surfaces) {
  std::vector<std::vector<double>> rows;
  for (std::size_t n = 0; n < surfaces.bin.x.size(); ++n)
    rows.push_back({surfaces.bin.x[n], surfaces.bin.z[n], surfaces.hopper.z.empty() ? no_value : surfaces.hopper.z[n]});
  write_table(path, {{"x", "m"}, {"bin_surface", "m"}, {"hopper_surface", "m"}}, rows);
}

/// When layers of the bed at the opening of the gate leave it.
void write_residence(const std::filesystem::path& path, const HopperRun& run,
                     const std::vector<std::filesystem::path>& snapshots) {
  constexpr std::size_t layers = 10;
  const std::vector<double>& time = run.snapshots.time();
  std::optional<Residence> residence;
  for (std::size_t n = 0; n < time.size(); ++n) {
    if (n + 1 < time.size() && time[n + 1] <= 0) continue;
    const PointSet points = read_points(snapshots[n]);
    const auto is_coarse = [](double mass_ratio) { return continuum::level_of(mass_ratio) > 0; };
    if (std::ranges::any_of(points.view().mass_ratios().of, is_coarse)) return;  // which become others
    if (residence)
      residence->take(points.view(), time[n]);
    else
      residence.emplace(points.view(), run.setting.shape.outlet->height, layers);
  }
  if (!residence) return;
  std::vector<std::vector<double>> rows;
  for (const LayerResidence& layer : residence->layers())
    rows.push_back({layer.low, layer.high, layer.particles, layer.share_out, layer.first, layer.mean, layer.last});
  write_table(path,
              {{"low", "m"},
               {"high", "m"},
               {"particles", "1"},
               {"share_out", "1"},
               {"first", "s"},
               {"mean", "s"},
               {"last", "s"}},
              rows);
}

/// Along y, m.
double middle_of_vessel(const continuum::Parameters& p) {
  const continuum::VesselBounds around = continuum::bounds_of_vessel(p);
  return 0.5 * (around.low.y + around.high.y);
}

}  // namespace

std::vector<std::array<Vector3, 2>> section_of_vessel(const continuum::Layout& layout) {
  if (layout.given.vessel.empty()) return {};
  continuum::Boundary boundary = *layout.boundary;
  boundary.move_gates(std::numeric_limits<double>::infinity());
  return section_at(boundary.vessel(), middle_of_vessel(layout.given));
}

HopperSetting hopper_setting(const continuum::Setup& setup) {
  const continuum::Parameters& p = setup.given;
  HopperSetting setting{.shape = {.width = p.box.width,
                                  .depth = p.box.depth,
                                  .height = p.box.height,
                                  .outlet = {},
                                  .spacing = p.bed.spacing},
                        .domain = setup.boundary->domain().whole(),
                        .computed = setup.boundary->domain(),
                        .particle_mass = setup.lattice.mass,
                        .particles = static_cast<double>(continuum::bed_positions(setup).size()) * setup.copies,
                        .grain_density = p.grains.density,
                        .grain_diameter = p.grains.diameter,
                        .gravity = p.gravity.acceleration * std::cos(p.gravity.tilt),
                        .tilt = p.gravity.tilt,
                        .smoothing_length = {},
                        .air = p.air.enabled,
                        .has_floor = is_mirror(p.box.floor),
                        .level_ground = !p.wedge.half_angle && p.plates.empty() && p.vessel.empty(),
                        .stress_share = p.sph.stress_form == sph::StressForm::printed ? p.bed.packing : 1.0};
  setting.hand_discharge = discharge_by_hand(setup);
  setting.hand_emptying_time = time_of_discharge_by_hand(setup, 0.99 * setting.mass());
  setting.averaging_time = setup.scales.averaging_time;
  setting.time_scale = setup.scales.time;
  setting.bed_packing = p.bed.packing;
  setting.outlet_width = setup.outlet_width.value_or(0);
  setting.outlet_depth = p.box.depth;
  if (!p.vessel.empty()) {
    setting.middle = middle_of_vessel(p);
    setting.section = section_of_vessel(setup);
    setting.mass_flow_half_angle = mass_flow_half_angle_by_hand(setup);
    setting.bands = bands_of(setup);
    const std::vector<continuum::VesselOutlet>& outlets = setup.vessel_outlets;
    if (!outlets.empty()) {
      setting.outlet_depth = outlets.front().depth;
      setting.outlet_is_round = outlets.front().round;
      if (const continuum::VesselOutlet& first = outlets.front(); !first.round)
        setting.outlet_length = first.endless_along_x   ? p.box.width
                                : first.endless_along_y ? p.box.depth
                                                        : first.length;
    }
    if (outlets.size() > 1)
      for (const continuum::VesselOutlet& outlet : outlets)
        setting.outlets.push_back({outlet.name, discharge_by_hand(setup, outlet), outlet.narrow, outlet.gate});
  }
  if (setup.outlet)
    setting.shape.outlet = {setup.outlet->height, setup.outlet->left, setup.outlet->right};
  else if (p.plate.height)
    setting.shape.outlet = {*p.plate.height, p.plate.slit_left.value_or(0.5 * p.box.width),
                            p.plate.slit_right.value_or(0.5 * p.box.width)};
  if (p.sph.smoothing == continuum::Smoothing::fixed)
    setting.smoothing_length = sph::smoothing_length(setup.lattice.mass, setup.density);
  return setting;
}

HopperRun read_hopper(const std::filesystem::path& run_folder, const HopperSetting& setting,
                      std::size_t snapshot_memory) {
  HopperRun run{.setting = setting, .series = read_series(RunFolder(run_folder).series())};
  if (run.series.rows() == 0) throw FileError((run_folder / "series.csv").string(), "has no rows");
  run.gate_time = gate_time_of(run.series);
  for (BandOfWall& band : run.setting.bands) {
    const std::string column = "normal_impulse_" + band.name;
    band.is_bare = run.series.has(column) && !(run.series.column(column).back() > 0);
  }
  const auto paths = snapshot_paths(run_folder);
  std::vector<double> time;
  for (const auto& path : paths) time.push_back(read_points_time(path) - run.gate_time);
  const auto reader = std::make_shared<Reader>(paths, time, run.setting, run.gate_time);
  run.snapshots = HopperRun::Numbers::of(
      std::move(time), [reader](std::size_t n) { return reader->read(n); },
      snapshots_in_memory(paths, snapshot_memory));
  return run;
}

std::vector<NamedValue> analyze_continuum(const std::filesystem::path& run_folder, const HopperRun& run) {
  const HopperSetting& setting = run.setting;
  const std::filesystem::path folder = run_folder / "analysis";
  make_folder(folder);
  write_snapshots(folder / "snapshots.csv", run, hopper_measures(), "s");
  if (setting.shape.outlet)
    write_table(
        folder / "discharge.csv", {{"time", "s"}, {"discharge_rate", "kg/s"}},
        mean_rates(passed_mass(run), hopper::averages(run).largest, hopper::averages(run).curve_every, 0, run.end()));
  if (const auto paths = snapshot_paths(run_folder); !paths.empty()) {
    if (setting.shape.outlet && !setting.section.empty()) write_residence(folder / "residence.csv", run, paths);
    const PointSet last = read_points(paths.back());
    write_surfaces(folder / "surfaces.csv", HopperSnapshot(setting, last.view(), run.gate_time).surfaces());
  }
  std::vector<NamedValue> quantities = summary_of(run, hopper_measures());
  const RunRecord record{.series = {}, .summary = quantities};
  const std::vector<NamedValue> of_outlets =
      outlet_quantities(run, record.value("discharge_steady_from"), record.value("discharge_steady_to"));
  quantities.insert(quantities.end(), of_outlets.begin(), of_outlets.end());
  return quantities;
}

}  // namespace talus::app
