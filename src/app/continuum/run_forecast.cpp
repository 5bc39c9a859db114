// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/run_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
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

/// Whether nothing falls through the box: no side is open, and walls are below every place.
bool is_closed_below(const Setup& setup) {
  constexpr int places = 20;  // along an axis
  const Box& box = setup.boundary->domain().box();
  for (int axis = 0; axis < 2; ++axis)
    for (const int side : {0, 1})
      if (box.face(axis, side) == FaceKind::open) return false;
  for (int j = 0; j < places; ++j)
    for (int i = 0; i < places; ++i) {
      const double x = box.low.x + (i + 0.5) / places * box.extent(0),
                   y = box.low.y + (j + 0.5) / places * box.extent(1);
      if (!setup.boundary->vessel().blocks({x, y, box.high.z}, {x, y, box.low.z})) return false;
    }
  return true;
}

/// That inlets have let in and that is still there, in the mean until `end`, s. Where upright walls are about an inlet
/// or nothing falls through the box its grains stay; elsewhere they run to the farthest corner and are taken away.
double mean_mass_come(const Setup& setup, double end) {
  const Parameters& p = setup.given;
  const SiloShape shape(setup);
  const bool leave = (p.removal.below || p.removal.outside || p.box.floor == FaceKind::open) && !is_closed_below(setup);
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
  if (count == 0)
    throw NumericalError({.what = "no particle is left: [removal] takes all of them away at the start",
                          .term = {},
                          .place = {},
                          .advice = "a bed above removal.below"});
  const double duration = p.air.enabled ? 0.6 : 0.2;  // the air's steps are longer, and few
  const double step = seconds_of(team, duration, [&] { model.advance(team); });
  const double with_build = seconds_of(team, duration, [&] {
    model.drop_lists();
    model.advance(team);
  });
  return (step + builds * std::max(0.0, with_build - step)) / count;
}

/// What inlets bring in the mean, as a bed; nothing where the vessel does not hold it.
std::shared_ptr<const Setup> filled(const Setup& setup, double end) {
  constexpr double enough = 0.5;  // of the mass
  Parameters p = setup.given;
  p.inlets.clear(), p.removal = {};
  p.bed.mass = mean_mass_come(setup, end);
  const continuum::Layout level = with_level(setup.with(p));
  if (!(level.given.bed.height > 0 && level.lattice.mass * continuum::bed_count(level) > enough * *p.bed.mass))
    return nullptr;
  return std::make_shared<const Setup>(level);
}

/// So many particles on the walls that are below inlets, layer by layer, the nearest first: as grains lie on a belt or
/// a chute; nothing where there are none.
std::shared_ptr<const Setup> laid_on_walls(const Setup& setup, double count) {
  constexpr double max_columns = 1e6;
  struct Column {
    double x, y, floor, way;  // way: to the nearest inlet, m
  };
  Parameters p = setup.given;
  if (p.vessel.empty()) return nullptr;
  const SiloShape shape(setup);
  const bool is_held = std::all_of(p.inlets.begin(), p.inlets.end(), [&](const continuum::Inlet& inlet) {
    return shape.upright_at({inlet.centre[0], inlet.centre[1], inlet.centre[2]}) != nullptr;
  });
  if (is_held) return nullptr;
  const double spacing = p.bed.spacing;
  double top = 0;
  for (const continuum::Inlet& inlet : p.inlets) top = std::max(top, inlet.centre[2]);
  const auto [low, high] = continuum::bounds_of_vessel(p);
  const double left = std::max(0.0, low.x), front = std::max(0.0, low.y);
  const double many_x = std::floor((std::min(p.box.width, high.x) - left) / spacing + 1e-9);
  const double many_y = std::floor((std::min(p.box.depth, high.y) - front) / spacing + 1e-9);
  if (!(many_x >= 1 && many_y >= 1 && many_x * many_y <= max_columns)) return nullptr;
  std::vector<Column> columns;
  for (double j = 0; j < many_y; ++j)
    for (double i = 0; i < many_x; ++i) {
      const double x = left + (i + 0.5) * spacing, y = front + (j + 0.5) * spacing;
      const auto wall = setup.boundary->vessel().first_crossing({x, y, top}, {x, y, 0});
      if (!wall) continue;
      Column column{x, y, top * (1 - wall->at), std::numeric_limits<double>::infinity()};
      for (const continuum::Inlet& inlet : p.inlets)
        column.way = std::min(column.way, std::hypot(x - inlet.centre[0], y - inlet.centre[1]));
      columns.push_back(column);
    }
  std::stable_sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) { return a.way < b.way; });
  continuum::GivenBed bed;
  bool has_room = true;
  for (double layer = 0; has_room; ++layer) {
    has_room = false;
    for (const Column& column : columns) {
      const double z = column.floor + (layer + 0.5) * spacing;
      if (!(z < top) || !(static_cast<double>(bed.position.size()) < count)) continue;
      bed.position.push_back({column.x, column.y, z});
      has_room = true;
    }
  }
  if (bed.position.empty()) return nullptr;
  bed.low = bed.high = bed.position.front();
  for (const Vector3& x : bed.position)
    for (int axis = 0; axis < 3; ++axis)
      bed.low[axis] = std::min(bed.low[axis], x[axis]), bed.high[axis] = std::max(bed.high[axis], x[axis]);
  p.inlets.clear(), p.removal = {};
  p.bed.given = std::make_shared<const continuum::GivenBed>(std::move(bed));
  return std::make_shared<const Setup>(with_level(setup.with(p)));
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
  const auto in_sample = [&](double count) {
    return measure_particle(Setup(sample(*setup, std::min(count, max_measured))), builds, team);
  };
  if (setup->has_no_bed()) {
    const double mean_count = mean_mass_come(*setup, end) / setup->lattice.mass;
    if (const auto laid = laid_on_walls(*setup, std::min(mean_count, max_measured)))
      return mean_count * measure_particle(*laid, builds, team);
    const auto bed = filled(*setup, end);
    if (!bed) return mean_count * in_sample(mean_count);
    setup = itself = bed;
  }
  const double count = continuum::bed_count(*setup);
  const double share = continuum::share_of_particles(*given);
  if (share * count <= max_measured) return share * count * measure_particle(*itself, builds, team);
  const double inside = in_sample(count);
  if (setup->given.vessel.empty()) return share * count * inside;
  const Setup coarse(continuum::coarser(*setup, max_measured));
  const double by_walls = std::max(0.0, measure_particle(coarse, builds, team) - inside);
  return share * count * (inside + by_walls * setup->given.bed.spacing / coarse.given.bed.spacing);
}

}  // namespace talus::app
