// SPDX-License-Identifier: Apache-2.0
#include "app/air/air_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

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

std::vector<NamedValue> groups(const ModelParameters& p) {
  const double rho = p.gas.density();
  double wall_speed = 0;
  for (const auto& v : p.gas.wall_velocity) wall_speed = std::max(wall_speed, std::hypot(v[0], v[1], v[2]));
  const double speed = p.start.flow == air::InitialFlow::rest ? wall_speed : p.start.speed;
  return {{"cells", "1", static_cast<double>(air::grid_of(p).cells())},
          {"density", "kg/m3", rho},
          {"reynolds_number_of_the_box", "1", rho * speed * p.box.width / p.gas.viscosity}};
}

Forecast forecast(const ModelParameters& p, const run::RunParameters& run) {
  AirModel model(p);
  ThreadTeam team(1);
  model.begin(team);
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0;
  int steps = 0;
  do {
    model.advance(team);
    ++steps;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } while (elapsed < 0.2);
  const double cells = static_cast<double>(air::grid_of(p).cells());
  Forecast f;
  f.steps = f.evaluations = std::ceil(run.end / model.state().last_step);
  f.seconds_per_evaluation = elapsed / steps;
  f.memory_bytes = 20e6 + 900 * cells;
  f.disk_bytes = (run.end / run.snapshots + 1) * (16 * cells + 20e3) + 2 * (60 * cells + 20e3) +
                 (run.series > 0 ? run.end / run.series : f.steps) * 250;
  return f;
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
  prepared.forecast = [p, run] { return forecast(p, run); };
  prepared.analyze = analyze_air;
  prepared.draw = [](const std::filesystem::path&) { return std::vector<std::filesystem::path>{}; };
  return prepared;
}

}  // namespace talus::app
