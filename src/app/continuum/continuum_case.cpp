// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/continuum/continuum_analysis.hpp"
#include "app/continuum/continuum_pictures.hpp"
#include "app/continuum/hopper_observers.hpp"
#include "base/instruction_set.hpp"
#include "io/parameter_reader.hpp"
#include "io/parameter_writer.hpp"
#include "models/continuum/atmosphere.hpp"
#include "models/continuum/material.hpp"
#include "models/continuum/model.hpp"

namespace talus::app {

namespace {

using continuum::Continuum;
using continuum::Parameters;

double bed_mass(const Parameters& p) {
  return continuum::lattice_of(p).mass * static_cast<double>(continuum::bed_positions(p).size());
}

std::vector<NamedValue> groups(const Parameters& p) {
  const double density = p.bed.packing * p.grains.density;
  const double sound = continuum::Material(p).sound_speed(density);
  const double fall = std::sqrt(2 * p.gravity.acceleration * p.box.height);
  std::vector<NamedValue> groups = {{"particles", "1", static_cast<double>(continuum::bed_positions(p).size())},
                                    {"mass", "kg", bed_mass(p)},
                                    {"sound_speed", "m/s", sound},
                                    {"mach_number_of_fall", "1", fall / sound},
                                    {"particles_across_grain", "1", p.grains.diameter / p.bed.spacing}};
  // Where the bed is as wide as the box from its bottom to its top.
  if (!p.wedge.half_angle && !p.bed.left && !p.bed.right && p.plates.empty())
    groups.push_back({"floor_stress_expected", "Pa",
                      density * p.gravity.acceleration * p.bed.height /
                          (p.sph.stress_form == sph::StressForm::printed ? p.bed.packing : 1.0)});
  if (const auto outlet = continuum::outlet_of(p))
    groups.push_back({"slit_over_spacing", "1", (outlet->right - outlet->left) / p.bed.spacing});
  return groups;
}

Forecast forecast(const Parameters& p, const run::RunParameters& run) {
  Continuum model(p);
  const double n = static_cast<double>(model.state().position.size());
  ThreadTeam team(1);
  model.begin(team);
  const auto start = std::chrono::steady_clock::now();
  int steps = 0;
  double elapsed = 0;
  do {
    model.advance(team);
    ++steps;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } while (elapsed < 0.2);
  Forecast f;
  const double settling =
      p.gate.opens == continuum::GateOpens::when_settled
          ? continuum::loading_time(p, continuum::Material(p).sound_speed(p.bed.packing * p.grains.density)) +
                p.settle.duration + 5 * p.settle.damping_time.value_or(p.settle.longest / 10)
          : p.gate.time;
  f.steps = std::ceil((run.end + settling) / model.state().last_step);
  f.evaluations = f.steps;
  f.seconds_per_evaluation = elapsed / steps;
  const double cells = p.air.enabled ? static_cast<double>(continuum::air_grid(p).cells()) : 0;
  f.memory_bytes = 20e6 + 3500 * n + 900 * cells;  // libraries; columns, records and lists of a particle and its images
  f.disk_bytes = (run.end / run.snapshots + 1) * (150 * n + 45 * cells + 20e3) + 2 * (350 * n + 250 * cells + 20e3) +
                 (run.series > 0 ? run.end / run.series : f.steps) * 600;
  return f;
}

}  // namespace

ParameterList continuum_parameters() {
  ParameterList list;
  const run::RunParameters run;
  Parameters parameters;
  parameters.plates.resize(1);  // whose keys stand for those of all
  for_each_parameter(list, run);
  for_each_parameter(list, parameters);
  return list;
}

PreparedCase prepare_continuum(const CaseFile& file) {
  Parameters p;
  run::RunParameters run;
  p.plates.resize(std::min<std::size_t>(file.tables("plates"), most_plates + 1));
  ParameterReader reader(file);
  run::for_each_parameter(reader, run);
  continuum::for_each_parameter(reader, p);
  reader.check(continuum::check(p));
  reader.finish();
  if (run.snapshots == 0) run.snapshots = run.end / 20;

  PreparedCase prepared;
  prepared.model = "continuum";
  prepared.run = run;
  prepared.defaults = continuum_parameters();
  run::for_each_parameter(prepared.parameters, run);
  continuum::for_each_parameter(prepared.parameters, p);
  prepared.instruction_set = choice_name(resolve(p.integration.instruction_set));
  prepared.groups = groups(p);
  prepared.make_model = [p] { return run::any_model(Continuum(p)); };
  prepared.observers = {[p](const Snapshot& snapshot) { return observe_hopper(snapshot, p); }};
  prepared.forecast = [p, run] { return forecast(p, run); };
  prepared.analyze = [p](const std::filesystem::path& folder) { return analyze_continuum(folder, hopper_setting(p)); };
  prepared.draw = [p, title = run.title](const std::filesystem::path& folder) {
    return draw_continuum(folder, hopper_setting(p), title);
  };
  return prepared;
}

HopperSetting hopper_setting_of(const CaseFile& resolved) {
  Parameters p;
  run::RunParameters run;
  ParameterReader reader(resolved);
  run::for_each_parameter(reader, run);
  continuum::for_each_parameter(reader, p);
  reader.finish();
  return hopper_setting(p);
}

std::vector<NamedValue> analyze_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder) {
  const PreparedCase prepared = prepare_continuum(resolved);
  std::vector<NamedValue> quantities = prepared.analyze(folder);
  prepared.draw(folder);
  return quantities;
}

}  // namespace talus::app
