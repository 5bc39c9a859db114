// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/wall_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/discharge.hpp"
#include "analysis/hopper_estimators.hpp"
#include "app/case/run_tables.hpp"
#include "app/continuum/design_code.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "io/series.hpp"
#include "models/continuum/boundary/vessel_loads.hpp"
#include "models/continuum/setup/bed_report.hpp"

namespace talus::app {

namespace {

/// m^2
double area_below(const std::vector<Triangle>& triangles, double height) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const auto [low, high] = std::minmax({t.corner[0].z, t.corner[1].z, t.corner[2].z});
    if (low >= height) continue;
    if (high <= height) {
      sum += norm(t.area());
      continue;
    }
    const std::vector<Vector3> part = clipped({t.corner.begin(), t.corner.end()}, 2, height, -1);
    for (std::size_t n = 2; n < part.size(); ++n) sum += norm(Triangle{{part[0], part[n - 1], part[n]}, 0}.area());
  }
  return sum;
}

/// Fields lie in rows, which borders between bands of equal heights would cut: a border lies where the wall below it
/// has the area of the fields below it.
void set_borders(const continuum::Layout& layout, std::vector<continuum::LoadBand>& bands) {
  constexpr double slack = 1e-6;
  for (std::size_t first = 0, last = 0; first < bands.size(); first = last) {
    double sum = 0;
    for (last = first; last < bands.size() && bands[last].patch == bands[first].patch; ++last) sum += bands[last].area;
    const std::vector<Triangle> triangles = triangles_of(layout.given, bands[first].patch);
    const double whole = area_below(triangles, std::numeric_limits<double>::infinity());
    double below = 0;
    for (std::size_t n = first; n + 1 < last; ++n) {
      below += bands[n].area;
      const auto misses = [&](double height) { return area_below(triangles, height) / whole - below / sum; };
      double border = bands[n].high;
      if (std::abs(misses(border)) > slack) {
        double low = bands[n].low, high = bands[last - 1].high;
        for (int k = 0; k < 50; ++k) {
          border = 0.5 * (low + high);
          (misses(border) < 0 ? low : high) = border;
        }
      }
      bands[n].high = bands[n + 1].low = border;
    }
  }
}

}  // namespace

std::vector<BandOfWall> bands_of(const continuum::Layout& layout) {
  const SurfaceFields fields = load_fields(layout);
  const std::vector<char> is_far = continuum::far_faces(layout, fields);
  std::vector<continuum::LoadBand> of_fields = load_bands(layout.given, fields);
  set_borders(layout, of_fields);
  std::vector<BandOfWall> bands;
  for (const continuum::LoadBand& band : of_fields) {
    double area = band.area, level = band.area * band.sine;
    for (const std::uint32_t n : band.fields)
      if (is_far[n]) area -= fields.all()[n].area, level -= fields.all()[n].area * std::abs(fields.all()[n].normal.z);
    if (!(area > 1e-9 * band.area)) area = level = 0;
    bands.push_back({.name = band.name,
                     .patch = band.patch,
                     .low = band.low,
                     .high = band.high,
                     .area = area,
                     .sine = area > 0 ? level / area : band.sine,
                     .gate = layout.boundary->patches()[layout.boundary->patch_of_part(band.patch)].gate});
  }
  return bands;
}

void write_wall_loads(const std::filesystem::path& run_folder, const HopperRun& run, const continuum::Setup& setup) {
  const std::vector<BandOfWall>& bands = run.setting.bands;
  if (bands.empty()) return;
  const Window flow = hopper::while_it_flows(run);
  const double measured = hopper::wall_pressure_ratio(run, {}), top = hopper::settled_top(run);
  const double ratio = std::isfinite(measured) ? measured : pressure_ratio_at_rest(setup);
  const SiloShape shape(setup);
  std::vector<std::vector<double>> rows;
  std::vector<SeriesColumn> columns = {{"time", "s"}};
  std::vector<Curve> curves;
  for (const BandOfWall& band : bands) {
    if (!(band.area > 0)) continue;
    const BandLoad load = load_of(run.series, band, run.gate_time, flow.from, flow.to, run.setting.averaging_time);
    // Of what the bed covers of it.
    const double middle = 0.5 * (band.low + (band.low < top ? std::min(band.high, top) : band.high));
    const PressureByHand hand = band.is_bare ? PressureByHand{} : pressure_by_hand(shape, band, ratio, top, middle);
    const CodeLoads code = band.is_bare ? CodeLoads{} : code_loads(shape, band, top, middle);
    rows.push_back({static_cast<double>(band.patch + 1),
                    band.low,
                    band.high,
                    band.area,
                    load.pressure_at_rest,
                    load.shear_at_rest,
                    load.pressure_in_flow,
                    load.shear_in_flow,
                    load.pressure_largest,
                    load.time_of_largest,
                    hand.at_rest,
                    hand.in_flow,
                    hand.in_flow_enstad,
                    code.pressure_filling,
                    code.shear_filling,
                    code.pressure_discharge,
                    code.shear_discharge,
                    code.pressure_filling_lower,
                    code.pressure_discharge_lower,
                    code.in_channel,
                    code.beside_channel});
    BandCurves of_band = curves_of(run.series, band, run.gate_time, run.setting.averaging_time);
    for (auto& [name, curve] : {std::pair{"pressure_", &of_band.pressure}, std::pair{"shear_", &of_band.shear}}) {
      if (curve->time.empty()) continue;
      columns.push_back({name + band.name, "Pa"});
      curves.push_back(std::move(*curve));
    }
  }
  const std::filesystem::path folder = run_folder / "analysis";
  write_table(folder / "wall_loads.csv",
              {{"patch", "1"},
               {"low", "m"},
               {"high", "m"},
               {"area", "m2"},
               {"pressure_at_rest", "Pa"},
               {"shear_at_rest", "Pa"},
               {"pressure_in_flow", "Pa"},
               {"shear_in_flow", "Pa"},
               {"pressure_largest", "Pa"},
               {"time_of_largest", "s"},
               {"pressure_at_rest_by_hand", "Pa"},
               {"pressure_in_flow_by_hand", "Pa"},
               {"pressure_in_flow_enstad", "Pa"},
               {"en_pressure_filling", "Pa"},
               {"en_shear_filling", "Pa"},
               {"en_pressure_discharge", "Pa"},
               {"en_shear_discharge", "Pa"},
               {"en_pressure_filling_lower", "Pa"},
               {"en_pressure_discharge_lower", "Pa"},
               {"en_pressure_in_channel", "Pa"},
               {"en_pressure_beside_channel", "Pa"}},
              rows);
  std::set<std::size_t> bare;
  for (const BandOfWall& band : bands) bare.insert(band.patch);
  for (const BandOfWall& band : bands)
    if (!band.is_bare) bare.erase(band.patch);
  write_design_code(run_folder, shape, top, bare);
  if (curves.empty()) return;
  std::vector<std::vector<double>> against_time;
  for (std::size_t n = 0; n < curves.front().time.size(); ++n) {
    against_time.push_back({curves.front().time[n]});
    for (const Curve& curve : curves) against_time.back().push_back(curve.value[n]);
  }
  write_table(folder / "wall_stress.csv", columns, against_time);
}

namespace {

struct Level {
  double low, high;  // m
};
/// Where the beds of the start lie if they fill the box from wall to wall, one on the other.
std::optional<Level> level_of_beds(const continuum::Setup& setup) {
  constexpr double most_apart = 1.0, least_full = 0.9;  // spacings; of the space between the lowest and the highest
  const continuum::Parameters& p = setup.given;
  Vector3 low{INFINITY, INFINITY, INFINITY}, high = -1 * low;
  double mass = 0;
  for (const std::size_t n : setup.beds) {
    const continuum::BedReport bed = continuum::report_of_bed(setup.with_bed_alone(n));
    mass += bed.mass;
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], bed.low[axis]), high[axis] = std::max(high[axis], bed.high[axis]);
  }
  const double apart = most_apart * p.bed.spacing, full = setup.density * p.box.width * p.box.depth * (high.z - low.z);
  const bool fills = low.x < apart && low.y < apart && high.x > p.box.width - apart && high.y > p.box.depth - apart;
  if (!fills || !(mass > least_full * full)) return std::nullopt;
  return Level{low.z, high.z};
}

}  // namespace

void write_box_walls(const std::filesystem::path& run_folder, const HopperRun& run, const continuum::Setup& setup) {
  const continuum::Parameters& p = setup.given;
  if (!p.vessel.empty() || p.wedge.half_angle || !p.plates.empty() || run.series.rows() < 2) return;
  if (p.gravity.tilt > 0 && p.box.left != FaceKind::periodic) return;  // it slides: what it covers is not known
  const std::optional<Level> beds = level_of_beds(setup);
  if (!beds) return;
  const double t = run.setting.averaging_time, end = run.end(), height = beds->high - beds->low;
  const double side = height * p.box.depth, face = height * p.box.width, ground = p.box.width * p.box.depth;
  struct Wall {
    const char* name;
    char axis;
    double area, low, high;
  };
  const double low = beds->low, high = beds->high;
  const Wall walls[] = {{"left", 'x', side, low, high},  {"right", 'x', side, low, high},
                        {"front", 'y', face, low, high}, {"rear", 'y', face, low, high},
                        {"floor", 'z', ground, 0, 0},    {"plate", 'z', ground, low, low}};
  const Window flow = hopper::while_it_flows(run);
  std::vector<std::vector<double>> rows;
  for (const Wall& wall : walls) {
    const Curve given = run.curve(fmt::format("impulse_{}_{}", wall.name, wall.axis));
    if (given.time.empty() || (p.plate.height && wall.low == 0 && wall.axis == 'z')) continue;  // a heap on the floor
    // Impulses on the left, the front and the ground point out of the box: against the axis.
    const bool is_low = wall.name != std::string_view("right") && wall.name != std::string_view("rear");
    const Curve impulse = scaled(given, (is_low ? -1 : 1) / wall.area);
    const Curve means = mean_rates(impulse, 0.5 * t, 0.05 * t, 0, end);
    const Extremes peak = means.time.empty() ? Extremes{0, no_value, no_value} : extremes(means);
    const auto patches = setup.boundary->patches();
    const auto number =
        std::find_if(patches.begin(), patches.end(), [&](const auto& patch) { return patch.name == wall.name; }) -
        patches.begin();
    rows.push_back({static_cast<double>(number + 1), wall.low, wall.high, wall.area, mean_rate(impulse, -t, 0),
                    mean_rate(impulse, flow.from, flow.to), peak.max, peak.max_time});
  }
  if (rows.empty()) return;
  write_table(run_folder / "analysis" / "box_walls.csv",
              {{"wall", "1"},
               {"low", "m"},
               {"high", "m"},
               {"area", "m2"},
               {"pressure_at_rest", "Pa"},
               {"pressure_in_flow", "Pa"},
               {"pressure_largest", "Pa"},
               {"time_of_largest", "s"}},
              rows);
}

}  // namespace talus::app
