// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/exact_sum.hpp"
#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/population.hpp"
#include "models/continuum/regime.hpp"
#include "models/continuum/sector.hpp"
#include "models/continuum/setup/time_scale.hpp"
#include "numerics/field.hpp"
#include "numerics/snapshot.hpp"

namespace talus::continuum {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notable_share = 0.1;  // of the particles: fewer are the edge of a stream

/// Whether Eqs 13 and 14 are used at rates beyond those for which the paper has them.
RegimeLine regime_of_collisions(const granular::CollisionParameters& collisions, const RunRecord& record) {
  const double over = std::max(record.value("velocity_gradient_shear_max") / granular::max_shear_rate,
                               record.value("velocity_gradient_normal_max") / granular::max_normal_rate);
  const bool unlimited = collisions.range == granular::CollisionRange::unlimited;
  return {"velocity gradients over the range of collisions", fmt::format("{:.3g}", over),
          fmt::format("the larger of velocity_gradient_shear_max over {:g} and velocity_gradient_normal_max over {:g}, "
                      "the largest in the paper's flow; beyond 1 the stress by collisions, Eqs 13 and 14, {}",
                      granular::max_shear_rate, granular::max_normal_rate,
                      unlimited ? "is extrapolated; collisions.range = \"printed\" holds it at what it is there"
                                : "stays what it is there"),
          unlimited && over > 1};
}

std::vector<RegimeLine> regime_of_air(const Parameters& p, const State& s, const AirTotals& cells, double mass) {
  const double solid_volume = mass / p.grains.density;
  const AirAround& air = s.air;
  const RegimeLine reynolds{"Reynolds number of a grain", fmt::format("{:.3g}", air.reynolds_max),
                            "largest since the start; the drag laws hold up to 1000", air.reynolds_max > 1000};
  // Frozen air has neither a pressure of its own nor a continuity that could lack anything.
  if (p.air.gas.motion == air::Motion::frozen) return {reynolds};
  const double swing = air.swing_max / p.air.gas.pressure;
  const bool incompressible = p.air.gas.compressibility == air::Compressibility::none;
  const double imbalance = cells.imbalance;
  return {{"air's pressure swing", fmt::format("{:.3g}", swing),
           incompressible ? "largest difference from air.pressure since the start, over it; the air is taken for "
                            "incompressible, which holds up to about 0.1: above it, grains that leave a closed vessel "
                            "are held back too strongly; air.compressibility = \"isothermal\" lets the air expand"
                          : "largest difference from air.pressure since the start, over it",
           incompressible && swing > 0.1},
          {"air's imbalance", fmt::format("{:.3g} cm3", imbalance * 1e6),
           fmt::format("room that grains left or took without air moving, {:.3g} of their volume; up to about 0.1 is "
                       "the grid's error, more is air.continuity = \"air-alone\" where grains change places with air",
                       imbalance / solid_volume),
           imbalance > 0.1 * solid_volume},
          reynolds};
}

}  // namespace

Continuum::Continuum(std::shared_ptr<const Setup> setup, ThreadTeam& team, const Ranks& ranks)
    : ranks_(ranks), setup_(std::move(setup)), state_(initial_state(*setup_, team, ranks.rank(), ranks.size())) {}

Continuum::Continuum(std::shared_ptr<const Setup> setup, const Ranks& ranks)
    : ranks_(ranks), setup_(std::move(setup)), state_(initial_state(*setup_, ranks.rank(), ranks.size())) {}

void Continuum::begin(ThreadTeam& team) {
  make_workspace();
  continuum::begin(team, *setup_, state_, *workspace_);
  workspace_->share.time() = {};
}

void Continuum::resume(ThreadTeam& team) {
  make_workspace();
  derive(team, *setup_, state_, *workspace_);
  workspace_->share.time() = {};
}

void Continuum::make_workspace() {
  workspace_ = std::make_unique<Workspace>(*setup_, state_, ranks_);
  if (domain().sector()) around_whole_.emplace(domain().whole());
  whole_.reset();
  part_.reset();
}

void Continuum::advance(ThreadTeam& team) {
  whole_.reset();
  part_.reset();
  const Stopwatch watch(workspace_->share.time().steps);
  continuum::advance(team, *setup_, state_, *workspace_);
}

void Continuum::gather() {
  Share& share = workspace_->share;
  totals_ = find_totals();
  at_end_ = find_at_end();
  air_totals_ = find_air_totals();
  share.collect_window(state_.wall_loads);
  account_ = share.account(workspace_->pairs.neighbourhood().pairs());
  whole_.reset();
  part_.reset();
}

void Continuum::gather_fields() {
  if (workspace_->air) workspace_->air->gather(state_.air);
}

AirTotals Continuum::find_air_totals() const {
  return workspace_->air ? workspace_->air->totals(state_.air) : AirTotals{};
}

Continuum::Totals Continuum::find_totals() const {
  const State& s = state_;
  const Box& box = domain().box();
  const Share& share = workspace_->share;
  // Particles past a periodic face come back at the next list build.
  const bool ends[] = {box.faces[0] != FaceKind::periodic, box.faces[2] != FaceKind::periodic,
                       box.faces[4] != FaceKind::periodic};
  double square = 0, min_density = infinity, max_density = -infinity, max_packing = -infinity;
  std::uint64_t outside = 0;
  const FixedPoint point(s.impulse_unit);
  FixedVector momentum;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (!share.owns(i)) continue;
    const Vector3 &x = s.position[i], &v = s.velocity[i];
    square = std::max(square, dot(v, v));
    momentum.add(point, s.mass_of(i) * v);
    min_density = std::min(min_density, s.density[i]);
    max_density = std::max(max_density, s.density[i]);
    max_packing = std::max(max_packing, s.packing[i]);
    const bool is_outside = (ends[0] & ((x.x < box.low.x) | (x.x > box.high.x))) |
                            (ends[1] & ((x.y < box.low.y) | (x.y > box.high.y))) |
                            (ends[2] & ((x.z < box.low.z) | (x.z > box.high.z)));
    if (is_outside) outside += s.units_of(i);
  }
  Votes votes{.least = {min_density}, .largest = {square, max_density, max_packing}, .sum = {outside}};
  join(ranks_, votes, std::span(&momentum, 1));
  const bool none = share.of_all(s.position.size()) == 0;
  const auto of_any = [none](double value) { return none ? std::numeric_limits<double>::quiet_NaN() : value; };
  return {.max_speed = std::sqrt(votes.largest[0]),
          .momentum = momentum.value(point),
          .min_density = of_any(votes.least[0]),
          .max_density = of_any(votes.largest[1]),
          .max_packing = of_any(votes.largest[2]),
          .mass_outside = s.mass_unit() * static_cast<double>(votes.sum[0])};
}

Continuum::AtEnd Continuum::find_at_end() const {
  const State& s = state_;
  const Parameters& p = setup_->given;
  const Share& share = workspace_->share;
  const double bound = setup_->material.range().max_inertial_number;
  double length = infinity, largest = 0;
  std::uint64_t bearing = 0, above = 0, units = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (!share.owns(i)) continue;
    units += s.units_of(i);
    length = std::min(length, workspace_->smoothing_length[i]);
    const double pressure = trace(tensor_at(s.material.stress, i)) / 3;
    largest = std::max(largest, pressure);
    if (!(pressure > 0)) continue;
    ++bearing;
    above += s.shear_rate[i] * p.grains.diameter * std::sqrt(p.grains.density / pressure) > bound;
  }
  Votes votes{.least = {length}, .largest = {largest}, .sum = {bearing, above, units}};
  ranks_.join(votes);
  const auto sum = [&](std::size_t n) { return static_cast<double>(votes.sum[n]); };
  return {.min_smoothing_length = votes.least[0],
          .max_pressure = votes.largest[0],
          .too_fast = votes.sum[0] > 0 ? sum(1) / sum(0) : 0,
          .mass = s.mass_unit() * sum(2)};
}

double Continuum::time_origin() const {
  return state_.gate_time >= 0 ? state_.gate_time : std::numeric_limits<double>::infinity();
}

double Continuum::latest_origin() const {
  if (state_.gate_time >= 0) return state_.gate_time;
  if (setup_->given.gate.opens == GateOpens::from_the_start) return 0;
  return setup_->given.gate.opens == GateOpens::at_time ? setup_->given.gate.time : setup_->scales.settling_limit;
}

double Continuum::has_moved_from() const {
  const double g = setup_->given.gravity.acceleration;
  const double fall = g > 0 ? std::sqrt(2 * setup_->given.bed.spacing / g) : 0;
  return std::max(state_.gate_time, fall);
}

std::optional<std::string> Continuum::ended() const {
  const std::size_t particles = workspace_->share.of_all(state_.position.size());
  if (!has_emptied(setup_->given, state_, particles)) return std::nullopt;
  return "all grains have left: the vessel has emptied";
}

NumericalError::Report Continuum::step_limit() const {
  return continuum::step_limit(*setup_, state_, *workspace_);
}

std::vector<NamedValue> Continuum::totals() const {
  const State& s = state_;
  const std::optional<Sector>& sector = domain().sector();
  const double copies = sector ? sector->copies() : 1;
  const Totals particles = ranks_.is_alone() ? find_totals() : totals_;
  std::vector<NamedValue> values = {{"step_size", "s", s.last_step},
                                    {"speed_max", "m/s", particles.max_speed},
                                    {"density_min", "kg/m3", particles.min_density},
                                    {"density_max", "kg/m3", particles.max_density},
                                    {"packing_max", "1", particles.max_packing},
                                    {"gate_time", "s", s.gate_time},
                                    {"mass_outside", "kg", copies * particles.mass_outside}};
  const auto add = [&](const std::string& name, const Vector3& given) {
    const Vector3 v = sector ? sector->of_all(given) : given;
    for (int axis = 0; axis < 3; ++axis) values.push_back({name + "_" + "xyz"[axis], "N s", v[axis]});
  };
  add("momentum", particles.momentum);
  add("impulse_gravity", s.gravity_impulse);
  add("impulse_damping", s.damping_impulse);
  for (std::size_t n = 0; n < s.patch_impulse.size(); ++n)
    if (setup_->boundary->bears_load(n)) add("impulse_" + setup_->boundary->patches()[n].name, s.patch_impulse[n]);
  for (NamedValue& value : totals_of(workspace_->load_bands, workspace_->load_fields, s.wall_loads))
    values.push_back(std::move(value));
  if (s.has.mass_ratio) values.push_back({"merged_energy", "J", copies * s.merged_energy});
  if (s.population.is_active) {
    values.push_back({"fed_mass", "kg", copies * s.mass * static_cast<double>(s.population.fed)});
    values.push_back({"removed_mass", "kg", copies * s.mass_unit() * static_cast<double>(s.population.removed)});
    add("fed_momentum", s.population.fed_momentum);
    add("removed_momentum", s.population.removed_momentum);
  }
  if (setup_->given.air.enabled) {
    const AirAround& air = s.air;
    const AirTotals cells = ranks_.is_alone() ? find_air_totals() : air_totals_;
    add("impulse_air", air.impulse);
    values.insert(values.end(), {{"air_force_z", "N", air.force.z},
                                 {"air_speed_max", "m/s", cells.max_speed},
                                 {"air_pressure_min", "Pa", cells.min_pressure},
                                 {"air_pressure_max", "Pa", cells.max_pressure},
                                 {"air_step_size", "s", air.flow.last_step},
                                 {"air_steps", "1", static_cast<double>(air.steps)},
                                 {"air_iterations", "1", static_cast<double>(air.iterations)},
                                 {"particle_reynolds_max", "1", air.reynolds_max},
                                 {"air_swing_max", "Pa", air.swing_max},
                                 {"air_imbalance", "m3", cells.imbalance}});
  }
  return values;
}

std::optional<GridSnapshot> Continuum::grid() const {
  const AirAround& air = state_.air;
  if (!setup_->given.air.enabled) return std::nullopt;
  GridSnapshot snapshot{.time = state_.time,
                        .step = state_.step,
                        .count = air.grid.count,
                        .low = air.grid.low,
                        .spacing = air.grid.spacing,
                        .columns = {}};
  std::vector<Vector3> velocity, grains, drag;
  std::vector<double> pressure, fraction;
  const RowRange all{0, air.grid.cells() / static_cast<std::size_t>(air.grid.count[0])};
  for_each_air_cell(air.grid, all, [&](std::size_t c, std::size_t) {
    const double solid = air.solids.fraction[c];
    Vector3 u, v, s;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      u[axis] = air.flow.cell_velocity(air.grid, axis, c);
      v[axis] = solid > 0 ? air.solids.flux[a][c] / solid : 0;
      s[axis] = air.flow.drag[a][c];
    }
    velocity.push_back(u), grains.push_back(v), drag.push_back(s);
    pressure.push_back(air.flow.pressure[c]), fraction.push_back(solid);
  });
  snapshot.columns = {{"velocity", "m/s", std::move(velocity)},
                      {"pressure", "Pa", std::move(pressure)},
                      {"solid_fraction", "1", std::move(fraction)},
                      {"grain_velocity", "m/s", std::move(grains)},
                      {"drag", "N/m3", std::move(drag)}};
  return snapshot;
}

std::optional<SurfaceSnapshot> Continuum::walls() const {
  if (setup_->given.vessel.empty()) return std::nullopt;
  Workspace& w = *workspace_;
  if (!w.load_mesh)
    w.load_mesh = mesh_of(w.boundary.vessel(), w.load_fields, edge_of_drawn_field * setup_->given.bed.spacing);
  SurfaceSnapshot snapshot = loads_on(*w.load_mesh, w.load_fields, state_.wall_loads, state_.time, state_.gate_time);
  snapshot.step = state_.step;
  return snapshot;
}

std::vector<RegimeLine> Continuum::regime(const RunRecord& record) const {
  const State& s = state_;
  const AtEnd end = ranks_.is_alone() ? find_at_end() : at_end_;
  const double c = setup_->sound_speed;
  // Of an empty vessel that of the bed's particles.
  const double h = end.mass == 0 ? workspace_->pairs.smoothing_length(setup_->density) : end.min_smoothing_length;
  const double step =
      end.mass == 0 ? setup_->given.integration.step.value_or(setup_->given.integration.courant * h / c) : s.last_step;
  const double courant = step * c / h;
  const double mach = record.largest("speed_max") / c, packing = record.largest("packing_max", has_moved_from());
  constexpr double max_packing = 0.74, slack = 1.02;
  const double at_start = !setup_->has_no_bed() && record.series.has("packing_max") && record.series.rows() > 0
                              ? record.series.column("packing_max").front()
                              : 0;
  const double slow = record.value("inertial_share");
  std::vector<RegimeLine> lines = regime_of_case(*setup_);
  const std::vector<RegimeLine> of_run = {
      courant_line(setup_->given.integration.method, courant),
      {"sound speed", fmt::format("{:.4g} m/s", c), "upper bound, used for the time step"},
      {"Mach number", fmt::format("{:.3g}", mach), "largest speed of the run over the sound speed", mach > 0.3},
      {"largest packing", fmt::format("{:.3f}", packing),
       "of a particle once the bed has settled or moved, as the kernel deposits it; at most 0.74 in grains" +
           (at_start > 0 ? fmt::format("; the lattice of the start, beside walls and about a sector's axis, has up to "
                                       "{:.3f}",
                                       at_start)
                         : ""),
       packing > (setup_->given.bed.given ? max_packing : std::max(max_packing, slack * at_start))},
      {"share of slow flow", fmt::format("{:.3f}", slow),
       "inertial_share: particles with an inertial number below 0.01; laws without a dependence on the rate hold there",
       slow < 0.5 && !std::isfinite(setup_->material.range().max_inertial_number)},
  };
  lines.insert(lines.end(), of_run.begin(), of_run.end());
  if (const std::size_t rows = record.series.rows(); rows > 1 && setup_->outlet) {
    const std::span<const double> time = record.series.column("time");
    const double apart = (time.back() - time.front()) / static_cast<double>(rows - 1),
                 half = 0.5 * setup_->scales.averaging_time;
    lines.push_back(
        {"time between rows of the series over T/2", fmt::format("{:.3g}", apart / half),
         fmt::format("peaks are averages over T/2 = {:.3g} s, rates over T, or over the time between rows, if that is "
                     "longer: take a shorter output.series",
                     half),
         apart > 2 * half});
  }
  if (const double most = setup_->material.range().max_pressure; std::isfinite(most)) {
    const double pressure = end.max_pressure;
    lines.push_back({"largest pressure", fmt::format("{:.4g} Pa", pressure),
                     fmt::format("at the end; the fit of the law ends at {:.4g} Pa", most), pressure > most});
  }
  if (const MaterialRange& range = setup_->given.grains.range; !range.name.empty()) {
    const double pressure = end.max_pressure, most = range.max_pressure;
    lines.push_back({"pressure for the material", fmt::format("{:.4g} Pa", pressure),
                     fmt::format("largest at the end; the values of {} hold up to {:.4g} Pa", range.name, most),
                     pressure > most});
  }
  if (const double most = setup_->material.range().max_inertial_number; std::isfinite(most)) {
    const double beyond = end.too_fast;
    lines.push_back({"share of flow too fast for the law", fmt::format("{:.3f}", beyond),
                     fmt::format("at the end, of the particles that bear a pressure those with an inertial number "
                                 "above {:g}, where the range of the law ends",
                                 most),
                     beyond > notable_share});
  }
  if (setup_->given.collisions.form != granular::Collisions::none)
    lines.push_back(regime_of_collisions(setup_->given.collisions, record));
  if (setup_->given.air.enabled)
    for (RegimeLine& line :
         regime_of_air(setup_->given, s, ranks_.is_alone() ? find_air_totals() : air_totals_, end.mass))
      lines.push_back(std::move(line));
  return lines;
}

}  // namespace talus::continuum
