// SPDX-License-Identifier: Apache-2.0
/// The pressure of the air: continuity, Eq. 19.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "models/air/flow.hpp"
#include "numerics/grid/loops.hpp"

namespace talus::air {

/// Fills the ghosts of a pressure so that its difference across every face of the box, over the distance of two
/// centres, is the gradient there: to an end of the box the way is half as long.
void AirFlow::fill_ghosts(CellField& pressure) const {
  const Grid& grid = apertures_.grid;
  apertures_.wrap(pressure);
  for (int axis = 0; axis < 3; ++axis) {
    if (apertures_.boundaries.is_periodic(axis)) continue;
    for (const int side : {0, 1}) {
      std::array<int, 3> layer = grid.count;
      layer[static_cast<std::size_t>(axis)] = 1;
      const int n = grid.count[static_cast<std::size_t>(axis)];
      const std::ptrdiff_t within = side == 0 ? 0 : (n - 1) * grid.stride(axis);
      const std::ptrdiff_t beyond = side == 0 ? -grid.stride(axis) : n * grid.stride(axis);
      const double outside = apertures_.boundaries.pressure[static_cast<std::size_t>(2 * axis + side)];
      for (int k = 0; k < layer[2]; ++k)
        for (int j = 0; j < layer[1]; ++j)
          for (int i = 0; i < layer[0]; ++i) {
            double* p = pressure.data() + grid.index(i, j, k);
            p[beyond] = 2 * outside - p[within];
          }
    }
  }
}

/// source_ := the volume flow into every own cell, of air and grains or of the air. \returns the largest sum of the
/// sizes of the flows through the low faces of one
double AirFlow::find_source(ThreadTeam& team, bool with_grains, const FaceField& velocity) {
  const Grid& grid = apertures_.grid;
  max_flow_.resize(static_cast<std::size_t>(grid.count[1]) * static_cast<std::size_t>(grid.count[2]));
  for_each_row(team, grid, grid.count, part_.own, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t) {
    VolumeFlowRow row{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto from = [&](const FaceField& field) { return field[static_cast<std::size_t>(axis)].data() + begin; };
      const DistinctRows& open = apertures_.rows.open[static_cast<std::size_t>(axis)];
      row.axis[axis] = {.open = open.at(grid.row(j, k)),
                        .open_after = open.at(grid.row(j, k) + grid.row_stride(axis)) + (axis == 0),
                        .void_fraction = from(void_fraction_),
                        .velocity = from(velocity),
                        .solid_fraction = from(solid_fraction_),
                        .grain_velocity = from(grain_velocity_),
                        .next = grid.stride(axis),
                        .area = grid.face_area(axis)};
    }
    max_flow_[static_cast<std::size_t>(k * grid.count[1] + j)] =
        find_source_of_row(grid.count[0], with_grains, row, source_.data() + begin);
  });
  if (comes_in_)
    for (const Inflow& in : inflow_)
      if (in.row >= part_.own_slab().begin && in.row < part_.own_slab().end) source_[in.cell] += in.into;
  double most = 0;
  for (std::size_t row = part_.own_slab().begin; row < part_.own_slab().end; ++row)
    most = std::max(most, max_flow_[row]);
  return most;
}

/// What an ideal gas takes in for each Pa, over the time, and adds to the source: the pressure at the start of the step
/// is where it would stay.
void AirFlow::find_storage(ThreadTeam& team, double dt) {
  const Grid& grid = apertures_.grid;
  storage_.resize(source_.size());
  for_each_cell(team, grid, part_.own, [&](int i, int j, int k, std::ptrdiff_t index) {
    const auto c = static_cast<std::size_t>(index);
    const double absolute = parameters_.pressure + start_pressure_[c];
    if (!(absolute > 0)) {
      const Vector3 x = grid.centre(i, j, k);
      throw NumericalError(
          {.what = fmt::format("the air's absolute pressure is {:.4g} Pa", absolute),
           .term = "ideal gas, air.compressibility = \"isothermal\"",
           .place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m", i, j, k, x.x, x.y, x.z),
           .advice = "a shorter air.max_step"});
    }
    storage_[c] = isothermal_compliance(cell_void_fraction_[c] * grid.volume(), absolute) / dt;
    source_[c] += storage_[c] * start_pressure_[c];
  });
}

/// The pressure that takes the divergence from the volume flow of the velocity that has not felt it yet.
/// The first guess goes on as the last two steps: it takes a third of the iterations away.
void AirFlow::project(ThreadTeam& team, double dt, AirState& state) {
  for (auto& conductance : conductance_) apertures_.wrap(conductance);
  for (auto& velocity : stream_.velocity) apertures_.wrap(velocity);
  const double flow =
      largest_of(part_.ranks, find_source(team, parameters_.continuity == Continuity::mixture, stream_.velocity));
  double* source = source_.data();
  for (int axis = 0; axis < 3; ++axis) {
    if (!apertures_.boundaries.is_open(axis, 0) && !apertures_.boundaries.is_open(axis, 1)) continue;
    for_each_run(team, apertures_, axis, part_.own, [&](const FaceRun& run) {
      if (!run.is_end) return;
      const auto a = static_cast<std::size_t>(axis);
      const double outside = apertures_.boundaries.pressure[2 * a + (run.index == 0 ? 0 : 1)];
      for (auto f = run.begin; f < run.end; ++f) source[f + run.here] += conductance_[a][f] * outside;
    });
  }
  const bool stores = parameters_.compressibility == Compressibility::isothermal;
  if (stores) together(part_.ranks, [&] { find_storage(team, dt); });
  solver_.set_conductance(team, conductance_, stores ? &storage_ : nullptr);
  // No smaller than what rounding leaves of the flows that the sources are differences of.
  const double rounding = 1e-15 * flow * std::sqrt(static_cast<double>(apertures_.grid.cells()));
  const double ratio = state.last_step > 0 ? dt / state.last_step : 0;
  for_each_row(team, apertures_.grid, apertures_.grid.count, part_.own,
               [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
                 lead_on_row(end - begin, ratio, state.pressure.data() + begin, state.pressure_before.data() + begin);
               });
  iterations_ += solver_
                     .solve(team, source_, state.pressure,
                            {.tolerance = parameters_.tolerance,
                             .absolute = rounding,
                             .max_iterations = static_cast<int>(parameters_.max_iterations)})
                     .iterations;
}

void AirFlow::add_outflow(ThreadTeam& team, double dt, const AirState& state, CellField& sum) {
  const Grid& grid = apertures_.grid;
  find_source(team, false, state.velocity);
  const double* pressure = state.pressure.data();
  const bool stores = parameters_.compressibility == Compressibility::isothermal;
  for_each_row(team, grid, grid.count, part_.own, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (auto index = begin; index < end; ++index) {
      const auto c = static_cast<std::size_t>(index);
      sum[c] -= source_[c] * dt / grid.volume();
      if (stores) sum[c] += storage_[c] * dt / grid.volume() * (pressure[c] - start_pressure_[c]);
    }
  });
}

double AirFlow::max_divergence(const Solids& solids, const AirState& state) {
  ThreadTeam alone;
  const Grid& grid = apertures_.grid;
  set_solids(alone, solids);
  find_source(alone, parameters_.continuity == Continuity::mixture, state.velocity);
  return max_of_cells(alone, grid, part_.own_slab(),
                      [&](std::ptrdiff_t c) { return std::abs(source_[static_cast<std::size_t>(c)]) / grid.volume(); });
}

}  // namespace talus::air
