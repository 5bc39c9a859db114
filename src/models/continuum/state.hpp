// SPDX-License-Identifier: Apache-2.0
/// The state of the grains as a continuum: its columns and counters, each named once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "models/air/state.hpp"
#include "models/continuum/boundary/vessel_loads.hpp"
#include "numerics/field.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/mass_ratios.hpp"
#include "physics/granular/material_point.hpp"

namespace talus::continuum {

/// What the law knows of each particle, column by column.
struct MaterialColumns {
  std::array<std::vector<double>, 6> stress;       ///< the law's, Pa, compression positive: xx yy zz xy yz zx
  std::array<std::vector<double>, 6> collisional;  ///< by collisions, Pa, the same order; empty without them
  std::vector<std::vector<double>> history;        ///< one column per slot of the law
};

/// The air around the particles, and what it does to them until its next step.
struct AirAround {
  Grid grid;           ///< from the case, not a field
  air::AirState flow;  ///< empty: no air
  air::Solids solids;  ///< as the last step met them
  /// Of every cell, what continuity of the air lacks since the start, over the cell's volume: how much more room there
  /// is for air than flowed in. What the grains' motion and air.continuity leave.
  CellField excess;
  std::vector<Vector3> acceleration;  ///< of each particle, m/s^2
  Vector3 force;                      ///< the same on all particles, N
  Vector3 impulse;                    ///< what they have received, N s
  std::uint64_t steps = 0;            ///< of the air
  std::uint64_t steps_left = 0;       ///< of the particles until the air's next
  std::uint64_t iterations = 0;       ///< of the pressure, last step
  double reynolds_max = 0;            ///< largest Reynolds number of a grain since the start
  double swing_max = 0;               ///< largest difference of a cell's pressure from air.pressure since the start, Pa
};

/// What has come and gone since the start.
struct Population {
  bool is_active = false;           ///< from the case, not a field: whether any can
  std::uint64_t next_identity = 0;  ///< of a particle to come
  std::uint64_t fed = 0;            ///< particles that came in
  std::uint64_t removed = 0;        ///< that were taken away, in State::mass_unit()
  Vector3 fed_momentum;             ///< what they brought, N s
  Vector3 removed_momentum;         ///< what they took along, N s
  std::vector<double> next_layer;   ///< of each inlet: when it is due, by its clock, s
};

struct State {
  double time = 0;         ///< s
  std::uint64_t step = 0;  ///< steps taken

  std::vector<Vector3> position;       ///< m
  std::vector<Vector3> velocity;       ///< m/s; with the leapfrog of half a step before
  std::vector<double> density;         ///< bulk density, kg/m^3
  std::vector<std::int64_t> identity;  ///< number of the particle at the start: columns are re-sorted now and then
  std::vector<double> mass_ratio;      ///< to `mass`, whole eighths; with levels, in a sector
  std::vector<std::int64_t> tag;       ///< of the bed that it belongs to, -1 of an inlet's; only with several beds
  MaterialColumns material;
  std::vector<granular::HistorySlot> slots;  ///< of material.history; from the law, not a field
  /// Which of the columns below there are. From the case, not fields: without particles every column is empty.
  struct Columns {
    bool mass_ratio = false, tag = false, collisional = false, reset_position = false, sector_turns = false,
         lasting_rate = false;
  } has;
  double mass = 0;           ///< of a particle, where masses differ of one of bed.spacing, kg
  double merged_energy = 0;  ///< kinetic, that merging particles lost since the start, J; with levels
  /// Largest mass times speed of sound, N s: more than a particle gives a wall in a step. Of sums in fixed point; from
  /// the case, not a field.
  double impulse_unit = 0;
  double energy_unit = 0;  ///< the same times the speed of sound, J
  /// X_i, m: where each particle was when its strain was last reset; empty unless the strain comes from displacements.
  std::vector<Vector3> reset_position;
  /// Of each particle in a sector, how many angles it has been turned back, from 0 to one circle; empty without one.
  std::vector<std::int64_t> sector_turns;

  std::vector<double>
      packing;                 ///< as the kernel deposits it: sum of m W over particles and images, over rho_p; derived
  std::vector<double> strain;  ///< |e|, norm of the strain that the law remembers; 0 if it remembers none; derived
  std::vector<double> shear_rate;  ///< (2 D':D')^(1/2), D' the deviator of the rate of deformation, last evaluated, 1/s
  /// D', averaged over what went before (measure_shear_rate), 1/s: xx yy zz xy yz zx; empty: densities are not drawn by
  /// it.
  std::array<std::vector<double>, 6> lasting_rate;

  std::vector<Vector3> patch_impulse;  ///< received by each patch of the boundary since the start, N s
  WallLoads wall_loads;                ///< the same by field of the vessel's surface
  Vector3 damping_impulse;             ///< what the damping of the settling bed took, N s
  Vector3 gravity_impulse;             ///< what gravity gave, N s

  Population population;
  AirAround air;

  MassRatios ratios() const { return {mass_ratio}; }
  double mass_of(std::size_t i) const { return ratios()[i] * mass; }  ///< kg
  /// Of what has its smoothing length (size_ratio), kg.
  double mass_of_size(std::size_t i) const { return size_ratio(ratios()[i]) * mass; }
  /// In which masses are counted: `mass` where all are equal, kg.
  double mass_unit() const { return has.mass_ratio ? mass / parts_of_mass : mass; }
  std::uint64_t units_of(std::size_t i) const {
    return has.mass_ratio ? static_cast<std::uint64_t>(parts_of_mass * mass_ratio[i]) : 1;
  }

  // Phases.
  double gate_time = -1;   ///< when the gate opened, s; -1: it has not
  double quiet_time = -1;  ///< since when the bed has been slower than settle.speed, s; -1: it is not

  // Where the neighbour lists were built: kept, so that a resumed run has the same lists.
  std::vector<Vector3> list_position;
  std::vector<double> list_smoothing_length;
  std::vector<double> list_margin;  ///< by which each particle may move and grow while they hold, m
  std::uint64_t list_builds = 0;
  double last_step = 0;  ///< s, length of the last step; 0 before the first
};

namespace detail {
inline constexpr std::array<const char*, 6> stress_names = {"stress_xx", "stress_yy", "stress_zz",
                                                            "stress_xy", "stress_yz", "stress_zx"};
inline constexpr std::array<const char*, 6> collisional_names = {"collisional_stress_xx", "collisional_stress_yy",
                                                                 "collisional_stress_zz", "collisional_stress_xy",
                                                                 "collisional_stress_yz", "collisional_stress_zx"};
inline constexpr std::array<const char*, 6> lasting_names = {"lasting_rate_xx", "lasting_rate_yy", "lasting_rate_zz",
                                                             "lasting_rate_xy", "lasting_rate_yz", "lasting_rate_zx"};
inline constexpr const char* damping_names[3] = {"impulse_damping_x", "impulse_damping_y", "impulse_damping_z"};
inline constexpr const char* gravity_names[3] = {"impulse_gravity_x", "impulse_gravity_y", "impulse_gravity_z"};
inline constexpr const char* fed_names[3] = {"fed_momentum_x", "fed_momentum_y", "fed_momentum_z"};
inline constexpr const char* removed_names[3] = {"removed_momentum_x", "removed_momentum_y", "removed_momentum_z"};
struct AirNames {
  const char *velocity, *momentum, *momentum_before, *drag, *solid_flux, *force, *impulse;
};
inline constexpr std::array<AirNames, 3> air_names{
    {{"air_velocity_x", "air_momentum_x", "air_momentum_before_x", "air_drag_x", "air_solid_flux_x", "air_force_x",
      "impulse_air_x"},
     {"air_velocity_y", "air_momentum_y", "air_momentum_before_y", "air_drag_y", "air_solid_flux_y", "air_force_y",
      "impulse_air_y"},
     {"air_velocity_z", "air_momentum_z", "air_momentum_before_z", "air_drag_z", "air_solid_flux_z", "air_force_z",
      "impulse_air_z"}}};
}  // namespace detail

template <class Visit, class A>
void for_each_field_of_air(Visit&& visit, A& a) {
  visit(FieldInfo{"air_acceleration", "m/s2"}, a.acceleration);
  const auto grid = [&](const char* name, const char* unit, auto& field) {
    visit(FieldInfo{name, unit, FieldRole::kept, false, false}, field);
  };
  grid("air_pressure", "Pa", a.flow.pressure);
  grid("air_pressure_before", "Pa", a.flow.pressure_before);
  grid("air_solid_fraction", "1", a.solids.fraction);
  grid("air_excess", "1", a.excess);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& names = detail::air_names[axis];
    grid(names.velocity, "m/s", a.flow.velocity[axis]);
    grid(names.momentum, "kg/(m2 s)", a.flow.momentum[axis]);
    grid(names.momentum_before, "kg/(m2 s)", a.flow.momentum_before[axis]);
    grid(names.drag, "N/m3", a.flow.drag[axis]);
    grid(names.solid_flux, "m/s", a.solids.flux[axis]);
    visit(FieldInfo{names.force, "N"}, a.force[static_cast<int>(axis)]);
    visit(FieldInfo{names.impulse, "N s"}, a.impulse[static_cast<int>(axis)]);
  }
  visit(FieldInfo{"air_steps", "1"}, a.steps);
  visit(FieldInfo{"air_steps_left", "1"}, a.steps_left);
  visit(FieldInfo{"air_iterations", "1"}, a.iterations);
  visit(FieldInfo{"air_last_step", "s"}, a.flow.last_step);
  visit(FieldInfo{"air_reynolds_max", "1"}, a.reynolds_max);
  visit(FieldInfo{"air_swing_max", "Pa"}, a.swing_max);
}

template <class Visit, class P>
void for_each_field_of_population(Visit&& visit, P& p) {
  visit(FieldInfo{"next_identity", "1"}, p.next_identity);
  visit(FieldInfo{"fed_particles", "1"}, p.fed);
  visit(FieldInfo{"removed_particles", "1"}, p.removed);
  for (int axis = 0; axis < 3; ++axis) {
    visit(FieldInfo{detail::fed_names[axis], "N s"}, p.fed_momentum[axis]);
    visit(FieldInfo{detail::removed_names[axis], "N s"}, p.removed_momentum[axis]);
  }
  if (!p.next_layer.empty()) visit(FieldInfo{"inlet_next_layer", "s", FieldRole::kept, false, false}, p.next_layer);
}

template <class Visit, class W>
void for_each_field_of_loads(Visit&& visit, W& w) {
  const auto column = [&](const char* name, const char* unit, auto& values) {
    visit(FieldInfo{name, unit, FieldRole::kept, false, false}, values);
  };
  column("load_push", "N s", w.push);
  column("load_received", "N s", w.received);
  column("load_window_push", "1", w.window_push.halves());
  column("load_window_received", "1", w.window_received.halves());
  column("load_gate_push", "N s", w.gate_push);
  column("load_gate_received", "N s", w.gate_received);
  column("load_pressure", "Pa", w.pressure);
  column("load_traction", "Pa", w.traction);
  column("load_rest_pressure", "Pa", w.rest_pressure);
  column("load_rest_traction", "Pa", w.rest_traction);
  column("load_largest", "Pa", w.max_pressure);
  column("load_largest_time", "s", w.max_time);
  visit(FieldInfo{"load_window_start", "s"}, w.window_start);
}

template <class Visit, class S>
void for_each_field(Visit&& visit, S& s) {
  visit(FieldInfo{"time", "s"}, s.time);
  visit(FieldInfo{"step", "1"}, s.step);
  visit(FieldInfo{"position", "m"}, s.position);
  visit(FieldInfo{"velocity", "m/s"}, s.velocity);
  visit(FieldInfo{"density", "kg/m3"}, s.density);
  visit(FieldInfo{"identity", "1"}, s.identity);
  if (s.has.mass_ratio) {
    visit(FieldInfo{"mass_ratio", "1"}, s.mass_ratio);
    visit(FieldInfo{"merged_energy", "J"}, s.merged_energy);
  }
  if (s.has.tag) visit(FieldInfo{"tag", "1"}, s.tag);
  for (std::size_t c = 0; c < 6; ++c) visit(FieldInfo{detail::stress_names[c], "Pa"}, s.material.stress[c]);
  for (std::size_t c = 0; c < 6 && s.has.collisional; ++c)
    visit(FieldInfo{detail::collisional_names[c], "Pa", FieldRole::kept, false}, s.material.collisional[c]);
  for (std::size_t k = 0; k < s.slots.size(); ++k)
    visit(FieldInfo{s.slots[k].name, s.slots[k].unit, FieldRole::kept, s.slots[k].in_snapshots}, s.material.history[k]);
  visit(FieldInfo{"mass", "kg"}, s.mass);
  if (s.has.reset_position) visit(FieldInfo{"reset_position", "m", FieldRole::kept, false}, s.reset_position);
  if (s.has.sector_turns) visit(FieldInfo{"sector_turns", "1", FieldRole::kept, false}, s.sector_turns);
  visit(FieldInfo{"packing", "1", FieldRole::derived}, s.packing);
  visit(FieldInfo{"strain", "1", FieldRole::derived}, s.strain);
  visit(FieldInfo{"shear_rate", "1/s"}, s.shear_rate);
  for (std::size_t c = 0; c < 6 && s.has.lasting_rate; ++c)
    visit(FieldInfo{detail::lasting_names[c], "1/s", FieldRole::kept, false}, s.lasting_rate[c]);
  for (int axis = 0; axis < 3; ++axis) {
    visit(FieldInfo{detail::damping_names[axis], "N s"}, s.damping_impulse[axis]);
    visit(FieldInfo{detail::gravity_names[axis], "N s"}, s.gravity_impulse[axis]);
  }
  visit(FieldInfo{"patch_impulse", "N s", FieldRole::kept, false, false}, s.patch_impulse);
  if (s.population.is_active) for_each_field_of_population(visit, s.population);
  if (!s.wall_loads.push.empty()) for_each_field_of_loads(visit, s.wall_loads);
  visit(FieldInfo{"gate_time", "s"}, s.gate_time);
  visit(FieldInfo{"quiet_time", "s"}, s.quiet_time);
  visit(FieldInfo{"list_position", "m", FieldRole::kept, false}, s.list_position);
  visit(FieldInfo{"list_smoothing_length", "m", FieldRole::kept, false}, s.list_smoothing_length);
  visit(FieldInfo{"list_margin", "m", FieldRole::kept, false}, s.list_margin);
  visit(FieldInfo{"list_builds", "1"}, s.list_builds);
  visit(FieldInfo{"last_step", "s"}, s.last_step);
  if (!s.air.flow.pressure.empty()) for_each_field_of_air(visit, s.air);
}

/// Velocity gradients of all particles.
struct GradientColumns {
  std::array<std::vector<double>, 9> component;  ///< du_i/dx_j, 1/s: xx xy xz yx yy yz zx zy zz

  void resize(std::size_t count) {
    for (auto& column : component) column.resize(count);
  }
  std::size_t size() const { return component[0].size(); }
  Tensor3<> operator[](std::size_t i) const {
    const auto& c = component;
    return {c[0][i], c[1][i], c[2][i], c[3][i], c[4][i], c[5][i], c[6][i], c[7][i], c[8][i]};
  }
};

}  // namespace talus::continuum
