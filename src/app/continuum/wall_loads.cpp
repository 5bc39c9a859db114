// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/wall_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "analysis/discharge.hpp"
#include "analysis/hopper_estimators.hpp"
#include "app/case/run_tables.hpp"
#include "app/continuum/design_code.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "io/series.hpp"
#include "models/continuum/boundary/vessel_loads.hpp"

namespace talus::app {

std::vector<BandOfWall> bands_of(const continuum::Layout& layout) {
  std::vector<BandOfWall> bands;
  for (const continuum::LoadBand& band : load_bands(layout.given, load_fields(layout)))
    bands.push_back({band.name, band.patch, band.low, band.high, band.area, band.sine});
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
    const double middle = 0.5 * (band.low + band.high);
    const PressureByHand hand = pressure_by_hand(shape, band, ratio, top, middle);
    const CodeLoads code = code_loads(shape, band, top, middle);
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
  write_design_code(run_folder, shape, top);
  if (curves.empty()) return;
  std::vector<std::vector<double>> against_time;
  for (std::size_t n = 0; n < curves.front().time.size(); ++n) {
    against_time.push_back({curves.front().time[n]});
    for (const Curve& curve : curves) against_time.back().push_back(curve.value[n]);
  }
  write_table(folder / "wall_stress.csv", columns, against_time);
}

void write_box_walls(const std::filesystem::path& run_folder, const HopperRun& run, const continuum::Setup& setup) {
  const continuum::Parameters& p = setup.given;
  const bool is_apart = p.bed.left || p.bed.right;
  if (!p.vessel.empty() || p.wedge.half_angle || !p.plates.empty() || is_apart || run.series.rows() < 2) return;
  const double t = run.setting.averaging_time, end = run.end(), bottom = setup.bottom;
  const double side = p.bed.height * p.box.depth, face = p.bed.height * p.box.width, ground = p.box.width * p.box.depth;
  struct Wall {
    const char* name;
    char axis;
    double area, low, high;
  };
  const double low = bottom, high = bottom + p.bed.height;
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
    const Extremes peak = means.time.empty() ? Extremes{0, HopperRun::none, HopperRun::none} : extremes(means);
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
