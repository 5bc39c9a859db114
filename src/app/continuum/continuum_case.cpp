// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "analysis/hopper_estimators.hpp"
#include "app/case/model_case.hpp"
#include "app/continuum/accuracy.hpp"
#include "app/continuum/answers.hpp"
#include "app/continuum/bed_file.hpp"
#include "app/continuum/bed_start.hpp"
#include "app/continuum/continuum_analysis.hpp"
#include "app/continuum/continuum_pictures.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "app/continuum/hopper_observers.hpp"
#include "app/continuum/ranks_forecast.hpp"
#include "app/continuum/run_forecast.hpp"
#include "app/continuum/shorter_runs.hpp"
#include "app/continuum/vessel_fields.hpp"
#include "app/continuum/wall_loads.hpp"
#include "app/materials/materials.hpp"
#include "base/instruction_set.hpp"
#include "base/unit.hpp"
#include "io/parameter_writer.hpp"
#include "io/stl.hpp"
#include "models/continuum/inlets.hpp"
#include "models/continuum/model.hpp"
#include "models/continuum/regime.hpp"
#include "models/continuum/setup/choices.hpp"
#include "models/continuum/setup/forecast.hpp"
#include "models/continuum/setup/layout.hpp"

namespace talus::app {

namespace {

using continuum::Continuum;
using continuum::Parameters;
using continuum::Setup;

constexpr std::size_t max_parts_of_vessel = 64, max_inlets = 16, max_beds = 64;

std::vector<NamedValue> groups(const Setup& setup) {
  const Parameters& p = setup.given;
  const double density = setup.density, sound = setup.sound_speed, count = continuum::bed_count(setup);
  const double particles = std::round(continuum::share_of_particles(setup) * count);
  std::vector<NamedValue> groups = {{"particles", "1", particles},
                                    {"mass", "kg", setup.lattice.mass * count * setup.copies},
                                    {"bed_height", "m", setup.has_no_bed() ? 0 : setup.depth},
                                    {"sound_speed", "m/s", sound},
                                    {"time_step", "s", continuum::time_step_of(setup)},
                                    {"particles_across_grain", "1", p.grains.diameter / p.bed.spacing}};
  if (const double fall = speed_of_fall(setup); fall > 0) groups.push_back({"mach_number_of_fall", "1", fall / sound});
  if (p.air.enabled) {
    const Grid grid = continuum::air_grid(p);
    groups.insert(groups.end(),
                  {{"air_cells", "1", static_cast<double>(grid.cells())}, {"air_cell_height", "m", grid.spacing.z}});
  }
  if (p.box.sector) groups.push_back({"sector_copies", "1", static_cast<double>(setup.copies)});
  // Where the bed is as wide as the box from its bottom to its top.
  if (!p.wedge.half_angle && !p.bed.left && !p.bed.right && !p.bed.front && !p.bed.rear && !p.bed.given &&
      p.beds.empty() && !setup.has_no_bed() && p.plates.empty() && p.vessel.empty())
    groups.push_back({"floor_stress_expected", "Pa",
                      density * p.gravity.acceleration * std::cos(p.gravity.tilt) * p.bed.height /
                          (p.sph.stress_form == sph::StressForm::printed ? p.bed.packing : 1.0)});
  if (const double rate = discharge_by_hand(setup); rate > 0) groups.push_back({"discharge_by_hand", "kg/s", rate});
  if (const auto& outlet = setup.outlet)
    groups.insert(groups.end(),
                  {{"outlet_width", "m", outlet->across}, {"slit_over_spacing", "1", outlet->across / p.bed.spacing}});
  if (const auto& outlets = setup.vessel_outlets; outlets.size() > 1)
    for (const continuum::VesselOutlet& outlet : outlets) {
      groups.push_back({"discharge_by_hand_" + outlet.name, "kg/s", discharge_by_hand(setup, outlet)});
      groups.push_back({"slit_over_spacing_" + outlet.name, "1", outlet.narrow / p.bed.spacing});
      groups.push_back({"slit_over_grain_" + outlet.name, "1", outlet.narrow / p.grains.diameter});
    }
  return groups;
}

Problem too_large(const Setup& setup, double end, double available) {
  const continuum::Forecast f = continuum::forecast(setup, end);
  const auto& count = setup.lattice.count;
  const double spacing = 1e3 * setup.given.bed.spacing;
  const auto dimensions = static_cast<double>(std::count_if(count.begin(), count.end(), [](auto n) { return n > 1; }));
  const double least = std::pow(continuum::memory_of(f) / available, 1 / std::max(1.0, dimensions));
  std::string what = fmt::format("{:.4g} mm makes {:.3g} particles", spacing, f.particles);
  if (f.cells > 0) what += fmt::format(" and {:.3g} cells of the air", f.cells);
  return {.key = "bed.spacing", .what = what, .allowed = fmt::format("at least {:.2g} mm", spacing * least)};
}

/// Reads the files of the vessel before the case is checked, so that their faults are told with the rest.
/// \returns those that cannot be read
std::vector<Problem> read_surfaces(const CaseFile& file, Parameters& p) {
  std::vector<Problem> problems;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    const std::string key = continuum::vessel_key(n, "file");
    const CaseEntry* entry = file.find(key);
    const auto* name = entry ? std::get_if<std::string>(&entry->value.value) : nullptr;
    if (name && !name->empty())
      read_input(key, problems, [&] {
        p.vessel[n].drawn = std::make_shared<continuum::DrawnSurface>(read_stl(input_path(file, *name)));
      });
  }
  return problems;
}

/// The same of the particles of bed.file.
std::vector<Problem> read_given_bed(const CaseFile& file, Parameters& p) {
  std::vector<Problem> problems;
  const CaseEntry* entry = file.find("bed.file");
  const auto* name = entry ? std::get_if<std::string>(&entry->value.value) : nullptr;
  if (name && !name->empty())
    read_input("bed.file", problems,
               [&] { p.bed.given = std::make_shared<continuum::GivenBed>(read_bed(input_path(file, *name))); });
  return problems;
}

/// Of the surfaces and particles that the files of the case hold.
std::string digest_of_files(const Parameters& p) {
  std::string bytes;
  const auto append = [&](const auto& column) {
    bytes.append(reinterpret_cast<const char*>(column.data()), column.size() * sizeof column[0]);
  };
  if (p.bed.given) append(p.bed.given->position), append(p.bed.given->velocity), append(p.bed.given->density);
  for (const continuum::VesselPart& part : p.vessel)
    for (const Triangle& t : part.drawn ? part.drawn->triangles() : std::span<const Triangle>{})
      bytes.append(reinterpret_cast<const char*>(t.corner.data()), sizeof t.corner);
  return bytes.empty() ? std::string() : digest(bytes);
}

struct ContinuumCase : ModelCase<Parameters> {
  FilledIn filled;  ///< what follows from other keys
  std::shared_ptr<const Setup> setup = nullptr;
};

/// \throws InputError with every problem
ContinuumCase read_as_it_is(const CaseFile& file) {
  Parameters defaults;
  std::vector<Problem> unreadable = read_given_bed(file, defaults);
  defaults.plates.resize(std::min<std::size_t>(file.tables("plates"), max_inner_walls + 1));
  defaults.vessel.resize(std::min(file.tables("vessel"), max_parts_of_vessel));
  defaults.inlets.resize(std::min(file.tables("inlet"), max_inlets));
  for (Problem& problem : read_surfaces(file, defaults)) unreadable.push_back(std::move(problem));
  defaults.beds.resize(std::min(file.tables("beds"), max_beds));
  for (std::size_t n = 0; n < defaults.beds.size(); ++n) defaults.beds[n].tag = static_cast<std::int64_t>(n) + 1;
  FilledIn filled = fill_in_material(file, defaults);
  const CaseFile without = without_own_material(file);
  ParameterReader reader(without, continuum::renamed_keys);
  reader.check(filled.problems);
  reader.check(std::move(unreadable));
  ContinuumCase read{{read_case(reader, std::move(defaults))}, std::move(filled)};
  const continuum::Layout layout = continuum::with_level(continuum::Layout(read.model));
  read.model = layout.given;
  if (!read.model.bed.file.empty())
    read.model.bed.file = std::filesystem::absolute(input_path(file, read.model.bed.file)).lexically_normal();
  set_from_bed(file, layout, read.run.end, read.model, read.filled);
  set_integration(file, read.model, read.filled);
  if (!file.contains("sph.viscosity_alpha")) {
    const double usual =
        std::exchange(read.model.sph.viscosity_alpha, Setup(layout.with(read.model)).default_viscosity());
    if (read.model.sph.viscosity_alpha < usual) {
      read.filled.keys.emplace("sph.viscosity_alpha", "bed");
      if (read.model.gate.opens != continuum::GateOpens::from_the_start && !read.model.settle.viscosity_alpha) {
        read.model.settle.viscosity_alpha = usual;
        read.filled.keys.emplace("settle.viscosity_alpha", "bed");
      }
    }
  }
  for (continuum::VesselPart& part : read.model.vessel)
    if (part.shape == continuum::VesselShape::stl)
      part.file = std::filesystem::absolute(input_path(file, part.file)).lexically_normal();
  read.model.grains.range.beyond = values_beyond_material(file, read.model);
  read.setup = std::make_shared<const Setup>(layout.with(read.model));
  reader.check(continuum::check_steps(*read.setup, read.run.end));
  reader.throw_problems();
  return read;
}

/// \param whole the case with what its accuracy sets \throws InputError with every problem
ContinuumCase read_with_accuracy(const CaseFile& whole) {
  try {
    return read_as_it_is(whole);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    // With other problems it is not known whether there is an outlet.
    if (problems.size() == 1 && problems[0].key == "bed.spacing" && whole.contains("accuracy") &&
        !whole.contains("bed.spacing"))
      problems[0].what += ", and accuracy sets it by an outlet, which this case lacks";
    throw InputError(std::move(problems));
  }
}

/// \throws InputError with every problem
ContinuumCase read_continuum(const CaseFile& file) {
  const CaseFile whole = with_accuracy(file, [](const CaseFile& trial) { return read_as_it_is(trial).setup; });
  ContinuumCase read = read_with_accuracy(whole);
  for (const CaseEntry& entry : whole.entries())
    if (!file.contains(entry.key)) read.filled.keys.insert_or_assign(entry.key, "accuracy");
  return read;
}

/// Lists parameters, those that follow from others without a value of their own.
struct WithoutWhatFollows {
  ParameterList parameters;

  template <class T>
  void operator()(const Parameter& parameter, const T& member) {
    static constexpr std::string_view following[] = {"integration.courant",
                                                     "integration.skin",
                                                     "sph.viscosity_alpha",
                                                     "law.critical-state.bulk_modulus",
                                                     "law.critical-state.shear_modulus",
                                                     "law.critical-state.reference_packing"};
    if constexpr (std::is_same_v<T, double>)
      if (std::find(std::begin(following), std::end(following), parameter.key) != std::end(following))
        return parameters(parameter, std::optional<T>{});
    parameters(parameter, member);
  }
};

class ContinuumRun : public OpenedRun {
 public:
  ContinuumRun(std::filesystem::path folder, std::shared_ptr<const Setup> setup, std::string title,
               std::size_t snapshot_memory)
      : OpenedRun(std::move(folder)),
        setup_(std::move(setup)),
        title_(std::move(title)),
        snapshot_memory_(snapshot_memory) {}

  std::vector<NamedValue> analyse() override {
    const Parameters& p = setup_->given;
    std::vector<NamedValue> quantities = analyze_continuum(folder(), run());
    write_box_walls(folder(), run(), *setup_);
    if (!p.vessel.empty()) {
      const continuum::VesselBounds around = continuum::bounds_of_vessel(p);
      const auto within = [&](const Vector3& x) {
        return Vector3{std::clamp(x.x, 0.0, p.box.width), std::clamp(x.y, 0.0, p.box.depth), x.z};
      };
      write_wall_loads(folder(), run(), *setup_);
      write_fields(folder(), run(), within(around.low), within(around.high));
    }
    return quantities;
  }
  std::vector<std::filesystem::path> draw() override { return draw_continuum(folder(), run(), title_); }
  std::vector<Answer> answers(const std::vector<NamedValue>& quantities) override {
    return answers_of(*setup_, quantities, run().end(), folder());
  }
  /// The middle of the discharge, from the opening of the gate, s; nothing where there is none.
  std::optional<double> telling_time() override {
    if (!run().setting.shape.outlet || hopper::flow_end(run()).state == hopper::FlowState::has_not_started)
      return std::nullopt;
    return hopper::while_it_flows(run()).at;
  }
  /// Box, walls and gates.
  Scene scene() override {
    Scene scene = scene_of(setup_->boundary->domain(), 0.5 * setup_->given.bed.spacing);
    for (const auto& [from, to] : section_of_vessel(*setup_)) scene.walls.push_back({from, to});
    return scene;
  }
  bool reaches(double time) override { return run().reaches(time); }
  double number(const std::string& quantity, const Window& window) override {
    return number_of<HopperRun>(run(), hopper_measures(), quantity, window);
  }

 private:
  const HopperRun& run() {
    if (!run_) run_ = read_hopper(folder(), hopper_setting(*setup_), snapshot_memory_);
    return *run_;
  }

  std::shared_ptr<const Setup> setup_;
  std::string title_;
  std::size_t snapshot_memory_;
  std::optional<HopperRun> run_;
};

}  // namespace

ParameterList continuum_parameters() {
  ModelCase<Parameters> defaults;
  defaults.model.plates.resize(1);  // whose keys stand for those of all
  defaults.model.vessel.resize(1);
  defaults.model.inlets.resize(1);
  defaults.model.beds.resize(1);
  WithoutWhatFollows list;
  for_each_parameter(list, defaults.run);
  for_each_parameter(list, defaults.model);
  return list.parameters;
}

PreparedCase prepare_continuum(const CaseFile& file) {
  const ContinuumCase read = read_continuum(file);
  const Parameters& p = read.model;
  const std::shared_ptr<const Setup> setup = read.setup;
  const double end = read.run.end;
  PreparedCase prepared = prepared_case("continuum", read);
  prepared.instruction_set = choice_name(resolve(p.integration.instruction_set));
  prepared.seed = p.seed;
  prepared.inputs = digest_of_files(p);
  prepared.filled_in = read.filled.keys;
  prepared.groups = groups(*setup);
  prepared.regime = continuum::regime_of_case(*setup);
  prepared.remarks = continuum::remarks_of_vessel(p);
  for (std::size_t n = 0; n < p.inlets.size(); ++n)
    if (const auto window = continuum::cut_window(*setup, p.inlets[n]); window && !window->by_wall)
      prepared.remarks.push_back(
          fmt::format("inlet {}: planes of symmetry leave {:.4g} x {:.4g} mm of its window; {:.4g} kg/s come in there",
                      n + 1, window->width / millimetre, window->depth / millimetre, p.inlets[n].rate));
  prepared.regime.push_back(continuum::courant_of_case(*setup));
  for (const std::size_t n : continuum::inlets_after(p, end))
    prepared.regime.push_back({continuum::inlet_key(n, "from"), fmt::format("{:.4g} s", p.inlets[n].from),
                               fmt::format("nothing comes in before run.end, {:.4g} s", end), true});
  for (const std::size_t n : continuum::inlets_past_vessel(*setup))
    prepared.regime.push_back({continuum::inlet_key(n, "centre"), "past the vessel",
                               "most grains that come in there meet no wall on their way down", true});
  if (const double opens = continuum::first_opening(setup->vessel_outlets); opens >= end && end > 0)
    prepared.regime.push_back({"opening of the first gate", fmt::format("{:.4g} s", opens),
                               fmt::format("none opens before run.end, {:.4g} s", end), true});
  prepared.start = [setup] { return bed_lines(*setup); };
  prepared.draw_start = [setup, title = read.run.title](const std::filesystem::path& path) {
    draw_bed(*setup, title, path);
  };
  prepared.make_model = [setup](ThreadTeam& team) { return run::any_model(Continuum(setup, team)); };
  prepared.make_part = [setup](ThreadTeam& team, const Ranks& ranks) {
    return run::any_model(Continuum(setup, team, ranks));
  };
  prepared.shared = {.count = continuum::forecast(*setup, end).particles,
                     .name = "particles",
                     .key = "bed.spacing",
                     .allowed = "some 10 000 particles on each pay"};
  prepared.on_ranks = [setup, end](ThreadTeam& team, double step, int ranks) {
    return forecast_on_ranks(*setup, end, air_of_step(*setup, team), step, ranks);
  };
  prepared.observers = {{.columns = {"position", "velocity", "density", "stress_zz", "strain", "mass_ratio"},
                         .observe = [setup](const Pieces& pieces) { return observe_hopper(pieces, *setup); }}};
  prepared.forecast = forecast_of_run(*setup, read.run);
  prepared.measure_evaluation = [setup, end](ThreadTeam& team) { return measure_step(setup, end, team); };
  prepared.shortenings = [setup, end] { return shorter_runs(*setup, end); };
  prepared.too_large = [setup, end](double available) { return too_large(*setup, end, available); };
  prepared.headline = p.plate.height || setup->outlet ? run::Headline{.column = "discharge_rate", .name = "discharge"}
                                                      : run::Headline{.column = "speed_max", .name = "fastest"};
  prepared.open = [setup, title = read.run.title](const std::filesystem::path& folder) {
    return std::make_unique<ContinuumRun>(folder, setup, title, OpenedRun::one_by_one);
  };
  return prepared;
}

std::unique_ptr<OpenedRun> open_continuum_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                              std::size_t snapshot_memory) {
  const ContinuumCase read = read_continuum(resolved);
  return std::make_unique<ContinuumRun>(folder, read.setup, read.run.title, snapshot_memory);
}

}  // namespace talus::app
