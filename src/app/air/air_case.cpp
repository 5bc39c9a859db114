// SPDX-License-Identifier: Apache-2.0
#include "app/air/air_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/stopwatch.hpp"
#include "base/instruction_set.hpp"
#include "io/parameter_reader.hpp"
#include "io/parameter_writer.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "models/air/model.hpp"

namespace talus::app {

namespace {

using air::AirModel;
using air::ModelParameters;

/// Largest velocity that is known before the run, m/s.
double known_speed(const ModelParameters& p) {
  double speed = p.start.flow == air::InitialFlow::rest ? 0 : p.start.speed;
  for (const auto& v : p.gas.wall_velocity) speed = std::max(speed, std::hypot(v[0], v[1], v[2]));
  return speed;
}

std::vector<NamedValue> groups(const ModelParameters& p) {
  const double rho = p.gas.density(), speed = known_speed(p);
  return {{"cells", "1", static_cast<double>(air::grid_of(p).cells())},
          {"density", "kg/m3", rho},
          {"reynolds_number_of_the_box", "1", rho * speed * p.box.width / p.gas.viscosity}};
}

/// Steps by the known velocity; what pressures at open faces make of the air is not known before.
Forecast forecast(const ModelParameters& p, const run::RunParameters& run) {
  const Vector3 size{p.box.width, p.box.depth, p.box.height};
  double cells = 1, crossing = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double count = std::max(1.0, std::round(size[axis] / p.cell));
    cells *= count, crossing = std::max(crossing, known_speed(p) * count / size[axis]);
  }
  const double step = std::min(p.gas.longest_step, crossing > 0 ? p.gas.courant / crossing : p.gas.longest_step);
  const double steps = std::ceil(run.end / step), rows = run.series > 0 ? run.end / run.series : steps;
  return {.phases = {{"flow", steps, steps}},
          .memory_bytes = 20e6 + 900 * cells,
          .disk_bytes = (run.end / run.snapshots + 1) * (16 * cells + 20e3) + 2 * (60 * cells + 20e3) + rows * 250};
}

double measure_step(const ModelParameters& p, ThreadTeam& team) {
  AirModel model(p);
  model.begin(team);
  return seconds_of(0.2, [&] { model.advance(team); });
}

Problem too_large(const ModelParameters& p, double available) {
  run::RunParameters run;
  run.end = run.snapshots = run.series = 1;
  const Forecast one = forecast(p, run);
  const double least = p.cell * std::cbrt(one.memory_bytes / available);
  return {.key = "air.cell",
          .what = fmt::format("{:.4g} mm makes more cells than memory holds", 1e3 * p.cell),
          .allowed = fmt::format("at least {:.2g} mm", 1e3 * least)};
}

}  // namespace

ParameterList air_parameters() {
  ParameterList list;
  const run::RunParameters run;
  const ModelParameters parameters;
  run::for_each_parameter(list, run);
  air::for_each_parameter(list, parameters);
  return list;
}

std::vector<NamedValue> analyze_air(const std::filesystem::path& folder) {
  const Series series = read_series(RunFolder(folder).series());
  std::vector<NamedValue> quantities;
  for (std::size_t n = 0; n < series.names.size(); ++n)
    if (series.rows() > 0 && series.names[n] != "time" && series.names[n] != "step")
      quantities.push_back({series.names[n], series.units[n], series.columns[n].back()});
  return quantities;
}

PreparedCase prepare_air(const CaseFile& file) {
  ModelParameters p;
  run::RunParameters run;
  ParameterReader reader(file);
  run::for_each_parameter(reader, run);
  air::for_each_parameter(reader, p);
  reader.check(air::check(p));
  reader.finish();
  if (run.snapshots == 0) run.snapshots = run.end / 20;

  PreparedCase prepared;
  prepared.model = "air";
  prepared.run = run;
  prepared.defaults = air_parameters();
  run::for_each_parameter(prepared.parameters, run);
  air::for_each_parameter(prepared.parameters, p);
  prepared.instruction_set = choice_name(resolve(InstructionSet::automatic));
  prepared.groups = groups(p);
  prepared.make_model = [p] { return run::any_model(AirModel(p)); };
  prepared.forecast = forecast(p, run);
  prepared.measure_evaluation = [p](ThreadTeam& team) { return measure_step(p, team); };
  prepared.too_large = [p](double available) { return too_large(p, available); };
  prepared.analyze = analyze_air;
  prepared.draw = [](const std::filesystem::path&) { return std::vector<std::filesystem::path>{}; };
  return prepared;
}

}  // namespace talus::app
