// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/run_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/statistics.hpp"
#include "app/case/model_case.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "app/materials/materials.hpp"
#include "models/continuum/model.hpp"
#include "models/continuum/setup/forecast.hpp"
#include "models/continuum/workspace.hpp"

namespace talus::app {

namespace {

using continuum::Parameters;
using continuum::Setup;

constexpr double max_measured = 8000;  // particles
// Discharge over the analytical rate: mill and concrete silo 0.76, silo-cone 0.89.
constexpr double of_analytical = 0.85;
// Speed at which lists break over the speed at the end of a fall: bin filling and chute 0.66, silo-cone 0.79.
constexpr double of_largest_fall = 0.7;

/// Where grains are taken away, or on the floor of the box, m/s.
double largest_speed(const Setup& setup) {
  return speed_of_fall(setup, setup.given.removal.below.value_or(0));
}

/// That inlets have let in and that is still there, in the mean until `end`, s. Where upright walls are about an inlet
/// its grains stay; elsewhere they run to the farthest corner and are taken away.
double mean_mass_come(const Setup& setup, double end) {
  const Parameters& p = setup.given;
  const SiloShape shape(setup);
  const bool leave = p.removal.below || p.removal.outside || p.box.floor == FaceKind::open;
  double mass = 0;
  for (const continuum::Inlet& inlet : p.inlets) {
    const double last = std::min(inlet.end(), end);
    if (!(last > inlet.from)) continue;
    double come = inlet.rate * (last - inlet.from) * (end - 0.5 * (inlet.from + last)) / end;
    const auto& [x, y, z] = inlet.centre;
    const double speed = inlet.speed() + largest_speed(setup);
    if (leave && speed > 0 && !shape.upright_at({x, y, z})) {
      const double way = std::hypot(std::max(x, p.box.width - x), std::max(y, p.box.depth - y), z);
      come = std::min(come, inlet.rate * 2 * way / speed);
    }
    mass += come;
  }
  return p.inlets.empty() ? 0 : std::min(mass, continuum::room_for_inlets(setup));
}

/// Particles in flow over those that measure_step() has: those that leave a vessel are taken away below it.
double mean_share_present(const Setup& setup, double end) {
  const Parameters& p = setup.given;
  if (setup.has_no_bed()) return 1;
  const double mass = setup.lattice.mass * continuum::bed_count(setup);
  if (!p.inlets.empty()) return 1 + mean_mass_come(setup, end) / mass;
  if (!(discharge_by_hand(setup) > 0) || !(p.removal.below || p.box.floor == FaceKind::open)) return 1;
  constexpr int times = 1000;
  std::vector<double> discharged;
  for (int n = 0; n < times; ++n) {
    const double passed = of_analytical * discharged_by_hand(setup, (n + 0.5) / times * end);
    discharged.push_back(std::min(1.0, passed / (mass * setup.copies)));
  }
  return mean(continuum::shares_left(setup, discharged));
}

/// The margins of lists in flow (set_list_reference()), whose particles have the mean speed of the vessel's cross
/// section.
Parameters with_lists_in_flow(const Setup& setup) {
  Parameters p = setup.given;
  const double mass = setup.lattice.mass * continuum::bed_count(setup) * setup.copies;
  const double half_skin = 0.5 * p.integration.skin * p.bed.spacing;
  if (!(mass > 0 && half_skin > 0)) return p;
  const double speed = discharge_by_hand(setup) * setup.depth / mass;
  const double margin = continuum::steps_of_margin * continuum::time_step_of(setup) * speed;
  p.integration.skin_at_rest = std::clamp(margin / half_skin, p.integration.skin_at_rest, 1.0);
  return p;
}

/// Of a step in flow, by particle.
double measure_particle(const Setup& given, double builds, ThreadTeam& team) {
  const auto setup = std::make_shared<const Setup>(given.with_same_bed(with_lists_in_flow(given)));
  const Parameters& p = setup->given;
  continuum::Continuum model(setup, team);
  continuum::State& s = model.mutable_state();
  // Walls cost more where the bed presses against them.
  if (!p.vessel.empty())
    for (std::size_t c = 0; c < 3; ++c)
      std::fill(s.material.stress[c].begin(), s.material.stress[c].end(),
                setup->density * p.gravity.acceleration * setup->depth);
  model.begin(team);
  const auto count = static_cast<double>(s.position.size());  // some may be taken away
  const double duration = p.air.enabled ? 0.6 : 0.2;          // the air's steps are longer, and few
  const double step = seconds_of(team, duration, [&] { model.advance(team); });
  const double with_build = seconds_of(team, duration, [&] {
    model.drop_lists();
    model.advance(team);
  });
  return (step + builds * std::max(0.0, with_build - step)) / count;
}

/// What inlets bring in the mean, as a bed; without a bed where it does not fit.
Setup filled(const Setup& setup, double end) {
  Parameters p = setup.given;
  p.inlets.clear();
  p.bed.mass = mean_mass_come(setup, end);
  return Setup(with_level(setup.with(p)));
}

}  // namespace

Forecast forecast_of_run(const Setup& setup, const run::RunParameters& run) {
  const continuum::Forecast f = continuum::forecast(setup, run.end);
  Forecast forecast{.phases = {}, .memory_bytes = continuum::memory_of(f), .disk_bytes = 0};
  if (f.settling_steps > 0)
    forecast.phases.push_back(
        {"settling", f.settling_steps, f.settling_steps, f.max_settling_steps / f.settling_steps});
  const double present = mean_share_present(setup, run.end);
  forecast.phases.push_back(
      {.name = "flow", .steps = f.flow_steps, .evaluations = present * f.flow_steps, .present = present});
  const double rows = run.series > 0 ? run.end / run.series : f.max_settling_steps + f.flow_steps;
  const double whole = run.end + f.settling_steps * continuum::time_step_of(setup);
  const double written = setup.given.inlets.empty()
                             ? f.particles
                             : continuum::share_of_particles(setup) * continuum::bed_count(setup) +
                                   mean_mass_come(setup, run.end) / setup.lattice.mass;
  forecast.disk_bytes = (whole / run.snapshots + 1) * (150 * written + 45 * f.cells + 150 * f.drawn_triangles + 20e3) +
                        (run.report ? 5e6 : 0) + 2 * (350 * f.particles + 250 * f.cells + 250 * f.load_fields + 20e3) +
                        rows * 600;
  return forecast;
}

double list_builds_of_step(const Setup& setup) {
  const Parameters& p = setup.given;
  const double step = continuum::time_step_of(setup), half_skin = 0.5 * p.integration.skin * p.bed.spacing;
  if (!(half_skin > 0)) return 1;
  double builds = std::max(1 / continuum::steps_of_margin, of_largest_fall * step * largest_speed(setup) / half_skin);
  for (const continuum::Inlet& inlet : p.inlets) builds = std::max(builds, step * inlet.speed() / p.bed.spacing);
  return std::min(1.0, builds);
}

/// A bed of a few thousand particles is measured itself, a larger one by a sample, and the walls of its vessel by
/// larger particles in it: with levels, as many particles of one size.
double measure_step(const std::shared_ptr<const Setup>& given, double end, ThreadTeam& team) {
  auto setup = given;
  if (given->given.levels.count > 0) {
    Parameters of_one_size = given->given;
    of_one_size.levels = {};
    setup = std::make_shared<const Setup>(given->with_same_bed(of_one_size));
  }
  const double builds = list_builds_of_step(*given);
  auto itself = given;
  if (setup->has_no_bed()) {
    const auto bed = std::make_shared<const Setup>(filled(*setup, end));
    if (continuum::bed_count(*bed) > 0) setup = itself = bed;
  }
  const auto in_sample = [&] { return measure_particle(Setup(sample(*setup, max_measured)), builds, team); };
  if (setup->has_no_bed()) return mean_mass_come(*given, end) / given->lattice.mass * in_sample();
  const double count = continuum::bed_count(*setup);
  const double share = continuum::share_of_particles(*given);
  if (share * count <= max_measured) return share * count * measure_particle(*itself, builds, team);
  const double inside = in_sample();
  if (setup->given.vessel.empty()) return share * count * inside;
  const Setup coarse(continuum::coarser(*setup, max_measured));
  const double by_walls = std::max(0.0, measure_particle(coarse, builds, team) - inside);
  return share * count * (inside + by_walls * setup->given.bed.spacing / coarse.given.bed.spacing);
}

}  // namespace talus::app
