// SPDX-License-Identifier: Apache-2.0
#include "models/air/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "numerics/grid/loops.hpp"
#include "physics/air/momentum.hpp"

namespace talus::air {

namespace {

std::array<bool, 3> periodic_axes(const FlowBoundaries& boundaries) {
  return {boundaries.is_periodic(0), boundaries.is_periodic(1), boundaries.is_periodic(2)};
}

/// Adds the wall velocities of the case to the boundaries.
Parameters with_moving_walls(Parameters p) {
  for (std::size_t face = 0; face < 6; ++face)
    p.boundaries.wall_velocity[face] +=
        Vector3{p.wall_velocity[face][0], p.wall_velocity[face][1], p.wall_velocity[face][2]};
  return p;
}

}  // namespace

AirFlow::AirFlow(const Grid& grid, const Parameters& parameters, const std::vector<Wall>& walls, const Surface& surface,
                 const Ranks& ranks)
    : parameters_(with_moving_walls(parameters)),
      medium_(parameters_.medium()),
      apertures_(grid, parameters_.boundaries, walls, surface),
      convection_(apertures_),
      solver_(grid, periodic_axes(parameters.boundaries), ranks),
      part_(ranks, grid, solver_.slabs()),
      viscosity_(apertures_, part_),
      drag_(grid.cell_field()),
      source_(drag_) {
  for (FaceField* field : {&void_fraction_, &solid_fraction_, &grain_velocity_, &decay_, &mean_, &after_drag_,
                           &conductance_, &predicted_, &stream_.velocity, &stream_.mass})
    *field = grid.face_field();
  find_inflow();
}

void AirFlow::set_walls(const std::vector<Wall>& walls, const Surface& surface) {
  apertures_ = FaceApertures(apertures_.grid, parameters_.boundaries, walls, surface);
}

void AirFlow::advance(ThreadTeam& team, double dt, const Solids& solids, AirState& state, FaceField& impulse) {
  if (parameters_.motion == Motion::frozen) return drag_alone(team, dt, solids, state, impulse);
  double stiffness = 0;  // of the Laplacian, 1/m^2
  for (int axis = 0; axis < 3; ++axis) stiffness += 4 / (apertures_.grid.spacing[axis] * apertures_.grid.spacing[axis]);
  implicit_ = dt * parameters_.viscosity / parameters_.density() * stiffness > 1;
  iterations_ = 0;
  extrapolate(team, dt, solids, state);
  if (parameters_.compressibility == Compressibility::isothermal) {
    start_pressure_ = state.pressure;
    cell_void_fraction_.resize(solids.fraction.size());
    for (std::size_t c = 0; c < solids.fraction.size(); ++c) cell_void_fraction_[c] = 1 - solids.fraction[c];
  }
  move(team, dt, state);
  finish(team, dt, state, impulse);
  exchange_at_inflow(dt, state, impulse);
  set_inflow(state.velocity, stream_.mass);
  part_.refresh(std::array{&state.velocity[0], &state.velocity[1], &state.velocity[2], &stream_.mass[0],
                           &stream_.mass[1], &stream_.mass[2]});
  for (std::size_t a = 0; a < 3; ++a) {
    apertures_.wrap(state.velocity[a]), apertures_.wrap(stream_.mass[a]);
    std::swap(state.momentum_before[a], state.momentum[a]), std::swap(state.momentum[a], stream_.mass[a]);
  }
  state.last_step = dt;
}

/// The solids on the faces; momentum in the middle of the step, from that at its start and at the start of the step
/// before, and the velocity that it has in the new void fraction; the drag at that velocity.
void AirFlow::extrapolate(ThreadTeam& team, double dt, const Solids& solids, const AirState& state) {
  const Grid& grid = apertures_.grid;
  together(part_.ranks, [&] { check_fractions(team, part_.own, solids.fraction); });
  const double share = state.last_step > 0 ? 0.5 * dt / state.last_step : 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_row(team, grid, apertures_.faces(axis), part_.midpoint,
                 [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
                   find_solids(solids, axis, j, k, begin, end);
                   extrapolate_row(end - begin, share, parameters_.density(), void_fraction_[a].data() + begin,
                                   state.momentum[a].data() + begin, state.momentum_before[a].data() + begin,
                                   stream_.mass[a].data() + begin, stream_.velocity[a].data() + begin);
                 });
    for (CellField* field : {&solid_fraction_[a], &void_fraction_[a], &grain_velocity_[a], &stream_.velocity[a]})
      apertures_.wrap(*field);
  }
  set_inflow(stream_.velocity, stream_.mass);
  convection_.fill_ghosts(stream_, parameters_.upwind);
  for_each_row(team, grid, grid.count, part_.beside, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t) {
    if (!implicit_) viscosity_.find_velocity_divergence_of_row(grid.row(j, k), begin, stream_.velocity);
    measure_drag_of_row(begin, cells_from(begin, solids, stream_.velocity));
  });
  if (!implicit_) viscosity_.wrap_velocity_divergence();
}

/// What air that does not move does to the grains.
void AirFlow::drag_alone(ThreadTeam& team, double dt, const Solids& solids, AirState& state, FaceField& impulse) {
  const Grid& grid = apertures_.grid;
  for_each_row(team, grid, grid.count, part_.own, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t) {
    measure_drag_of_row(begin, cells_from(begin, solids, state.velocity));
  });
  for_each_cell(team, grid, part_.own, [&](int, int, int, std::ptrdiff_t index) {
    const auto c = static_cast<std::size_t>(index);
    const double s = solids.fraction[c];
    for (std::size_t a = 0; a < 3; ++a) {
      state.drag[a][c] = s > 0 ? -drag_[c] * solids.flux[a][c] / s : 0;
      impulse[a][c] = s > 0 ? dt * state.drag[a][c] / s : 0;
    }
  });
  state.last_step = dt;
}

/// From the momentum at the start of the step: pressure, and velocity before the pressure acts, after dt under the
/// convection and viscosity of `stream_`, whose velocity it replaces.
void AirFlow::move(ThreadTeam& team, double dt, AirState& state) {
  const Grid& grid = apertures_.grid;
  const double rho = parameters_.density(), viscosity = implicit_ ? 0 : parameters_.viscosity;
  struct Forces {
    Convection::Rows convection;
    std::vector<double> viscous;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double area_over_distance = grid.face_area(axis) / grid.spacing[axis];
    const auto make = [&] {
      return Forces{convection_.rows(stream_, axis, parameters_.upwind),
                    std::vector<double>(static_cast<std::size_t>(apertures_.faces(axis, 0)))};
    };
    // Row by row, so that what one loop finds is at hand for the next.
    for_each_row(team, grid, apertures_.faces(axis), part_.with_next, make,
                 [&](Forces& forces, int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
                   const std::size_t row = grid.row(j, k);
                   const DistinctRows& open = apertures_.rows.open[a];
                   if (open.is_zero(row)) return close_row(axis, begin, end);
                   const double *convection = forces.convection.force(j, k, begin), *viscous = forces.viscous.data();
                   if (!implicit_)
                     viscosity_.find_divergence_of_row(axis, row, begin, static_cast<int>(end - begin),
                                                       stream_.velocity, forces.viscous.data());
                   for_each_run_of_row(apertures_, axis, j, k, begin, end, [&](const FaceRun& run) {
                     const auto from = [&](auto& field) { return field[a].data() + run.begin; };
                     const double* drag = drag_.data() + run.begin;
                     find_decay_of_row(run.end - run.begin, dt / rho, drag + run.before, drag + run.here,
                                       from(void_fraction_), from(decay_), from(mean_));
                     predict_row(run.end - run.begin, dt, rho, viscosity, grains_share(),
                                 (run.is_end ? 2 : 1) * dt / rho * area_over_distance,
                                 {.open = open.at(row) + (run.begin - begin),
                                  .void_fraction = from(void_fraction_),
                                  .momentum = from(state.momentum),
                                  .grain_velocity = from(grain_velocity_),
                                  .convection = convection + (run.begin - begin),
                                  .viscous = viscous + (run.begin - begin),
                                  .decay = from(decay_),
                                  .mean = from(mean_)},
                                 from(after_drag_), from(predicted_), from(conductance_));
                   });
                 });
  }
  std::swap(stream_.velocity, predicted_);
  set_inflow(stream_.velocity);
  if (implicit_) {
    // Includes the guessed pressure: viscosity then acts on the final velocity, and a steady flow is exact.
    add_pressure(team, dt, state.pressure);
    start_ = stream_.velocity;
    stream_.velocity = predicted_;  // at the midpoint: a better first guess than the velocity without viscosity
    viscosity_.advance_implicitly(team, start_, mean_, parameters_.viscosity / rho * dt, stream_.velocity);
    add_pressure(team, -dt, state.pressure);
  }
  project(team, dt, state);
  part_.refresh(std::array{&state.pressure});
  fill_ghosts(state.pressure);
}

/// Faces through which nothing passes.
void AirFlow::close_row(int axis, std::ptrdiff_t begin, std::ptrdiff_t end) {
  const auto a = static_cast<std::size_t>(axis);
  const auto fill = [&](FaceField& field, double value) {
    std::fill(field[a].data() + begin, field[a].data() + end, value);
  };
  for (FaceField* field : {&after_drag_, &predicted_, &conductance_}) fill(*field, 0);
  fill(decay_, 1), fill(mean_, 1);
}

/// Adds the pressure term over dt to the velocity.
void AirFlow::add_pressure(ThreadTeam& team, double dt, CellField& pressure) {
  const Grid& grid = apertures_.grid;
  fill_ghosts(pressure);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double factor = dt / (parameters_.density() * grid.spacing[axis]);
    for_each_row(team, grid, apertures_.faces(axis), part_.with_next,
                 [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
                   const double* high = pressure.data() + begin;
                   add_pressure_row(end - begin, factor, grains_share(),
                                    {.open = apertures_.open[a].data() + begin,
                                     .void_fraction = void_fraction_[a].data() + begin,
                                     .mean = mean_[a].data() + begin,
                                     .low = high - grid.stride(axis),
                                     .high = high},
                                    stream_.velocity[a].data() + begin);
                 });
  }
}

void AirFlow::begin(ThreadTeam& team, const Solids& solids, AirState& state) {
  set_solids(team, solids);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for_each_face(team, apertures_, axis, part_.all, [&](std::ptrdiff_t face) {
      const auto f = static_cast<std::size_t>(face);
      state.velocity[a][f] *= apertures_.open[a][f];
      state.momentum[a][f] = parameters_.density() * void_fraction_[a][f] * state.velocity[a][f];
    });
  }
  set_inflow(state.velocity, state.momentum);
  for (std::size_t a = 0; a < 3; ++a) {
    apertures_.wrap(state.velocity[a]);
    apertures_.wrap(state.momentum[a]);
    state.momentum_before[a] = state.momentum[a];
  }
  state.pressure_before = state.pressure;
}

}  // namespace talus::air
