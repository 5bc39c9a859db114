// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/initial.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/random.hpp"
#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/population.hpp"
#include "models/continuum/setup/wall_fitting.hpp"
#include "models/continuum/splitting.hpp"
#include "models/continuum/step.hpp"

namespace talus::continuum {

namespace {

/// Uniformly within bed.disorder spacings along each axis.
void displace(const Parameters& parameters, std::vector<Vector3>& positions) {
  const double most = parameters.bed.disorder * parameters.bed.spacing;
  if (!(most > 0)) return;
  Random random(static_cast<std::uint64_t>(parameters.seed));
  for (Vector3& x : positions)
    for (int axis = 0; axis < 3; ++axis) x[axis] += random.uniform(-most, most);
}

std::int64_t tag_of(const Parameters& parameters, std::size_t bed) {
  return bed == 0 ? 0 : parameters.beds[bed - 1].tag;
}

/// Particles of a bed after those that are there. \param layout of the case with this bed alone
void add_bed(const Layout& layout, std::int64_t tag, State& state) {
  const Parameters& one = layout.given;
  const std::vector<Vector3> positions = bed_positions(layout);
  const std::size_t count = state.position.size() + positions.size();
  state.position.insert(state.position.end(), positions.begin(), positions.end());
  const std::array<double, 3> velocity = one.bed.velocity.value_or(std::array<double, 3>{});
  state.velocity.resize(count, Vector3{velocity[0], velocity[1], velocity[2]});
  state.density.resize(count, one.bed.packing * one.grains.density);
  if (state.has.tag) state.tag.resize(count, tag);
  const auto& given = one.bed.given;
  const auto take = [count](const auto& of_file, auto& column) {
    if (!of_file.empty())
      std::copy(of_file.begin(), of_file.end(), column.begin() + static_cast<std::ptrdiff_t>(count - of_file.size()));
  };
  if (given) take(given->velocity, state.velocity), take(given->density, state.density);
}

}  // namespace

State initial_state(const Setup& setup, ThreadTeam& team, int part, int parts) {
  const Parameters& parameters = setup.given;
  const Material& material = setup.material;
  State state;
  state.mass = setup.lattice.mass;
  // A merged particle may have half as much again as its level.
  state.impulse_unit =
      state.mass * setup.sound_speed * (parameters.levels.count > 0 ? std::exp2(3 * parameters.levels.count + 1) : 1);
  state.energy_unit = state.impulse_unit * setup.sound_speed;
  state.has = {.mass_ratio = has_several_masses(parameters),
               .tag = !parameters.beds.empty(),
               .collisional = parameters.collisions.form != granular::Collisions::none,
               .reset_position = material.by_displacements(),
               .sector_turns = setup.sector().has_value(),
               .lasting_rate = draws_by_lasting_rate(parameters)};
  for (const std::size_t n : setup.beds) add_bed(setup.with_bed_alone(n), tag_of(parameters, n), state);
  const std::size_t given = parameters.bed.given ? parameters.bed.given->position.size() : 0;
  fit_to_walls(team, *setup.boundary, parameters.bed.spacing, given, state.position);
  displace(parameters, state.position);
  if (state.has.mass_ratio) lay_levels(setup, state);
  state.population = initial_population(setup, state.position.size());
  const auto border = [all = state.position.size(), parts](int n) {
    return static_cast<std::ptrdiff_t>(all * static_cast<std::size_t>(n) / static_cast<std::size_t>(parts));
  };
  const std::ptrdiff_t first = border(part), last = border(part + 1);
  if (parts > 1) {
    const auto keep = [first, last](auto& column) {
      if (!column.empty()) column = std::decay_t<decltype(column)>(column.begin() + first, column.begin() + last);
    };
    keep(state.position), keep(state.velocity), keep(state.density), keep(state.tag), keep(state.mass_ratio);
  }
  const std::size_t count = state.position.size();
  for (std::ptrdiff_t n = first; n < last; ++n) state.identity.push_back(n);
  for (auto& column : state.material.stress) column.assign(count, 0.0);
  if (state.has.lasting_rate)
    for (auto& column : state.lasting_rate) column.assign(count, 0.0);
  if (state.has.collisional)
    for (auto& column : state.material.collisional) column.assign(count, 0.0);
  state.patch_impulse.assign(setup.boundary->patches().size(), Vector3{});
  state.wall_loads = no_loads(count_load_fields(setup), state.impulse_unit);
  if (state.has.reset_position) state.reset_position = state.position;
  if (state.has.sector_turns) state.sector_turns.assign(count, 0);
  state.slots = material.slots();
  state.material.history.assign(state.slots.size(), std::vector<double>(count, 0.0));
  if (parameters.air.enabled) {
    state.air.grid = air_grid(parameters);
    state.air.flow = air::AirState(state.air.grid);
    state.air.solids = air::Solids(state.air.grid);
    state.air.excess = state.air.grid.cell_field();
    state.air.acceleration.assign(count, Vector3{});
  }
  return state;
}

State initial_state(const Setup& setup, int part, int parts) {
  ThreadTeam team;
  return initial_state(setup, team, part, parts);
}

}  // namespace talus::continuum
