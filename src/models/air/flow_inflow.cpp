// SPDX-License-Identifier: Apache-2.0
/// Air that comes in through a face of the box at a given velocity. The face is a wall to all loops over faces; its
/// velocity is set, and what comes in is a source of the cell behind it.
#include "models/air/flow.hpp"
#include "physics/air/momentum.hpp"
#include "physics/coupling/drag.hpp"

namespace talus::air {

bool comes_in_at(const Parameters& p, const Grid& grid, std::size_t face, const std::array<int, 3>& cell) {
  Vector3 x = grid.centre(cell[0], cell[1], cell[2]);
  const auto across = static_cast<int>(face / 2);
  const double half = 0.5 * grid.spacing[across];
  x[across] += face % 2 == 0 ? -half : half;
  for (const int b : {0, 1, 2}) {
    const auto n = static_cast<std::size_t>(b);
    const double slack = b == across ? half : 0;  // of the face itself
    if ((p.inflow_low && x[b] < (*p.inflow_low)[n] - slack) || (p.inflow_high && x[b] > (*p.inflow_high)[n] + slack))
      return false;
  }
  return true;
}

void AirFlow::find_inflow() {
  const Grid& grid = apertures_.grid;
  for (std::size_t a = 0; a < 3; ++a)
    for (const int side : {0, 1}) {
      const std::size_t number = 2 * a + static_cast<std::size_t>(side);
      if (apertures_.boundaries.kind[number] != FlowBoundary::inflow) continue;
      const int axis = static_cast<int>(a);
      const double velocity = apertures_.boundaries.wall_velocity[number][axis];
      std::array<int, 3> low{}, high = grid.count;
      low[a] = side == 0 ? 0 : grid.count[a] - 1, high[a] = low[a] + 1;
      for (int k = low[2]; k < high[2]; ++k)
        for (int j = low[1]; j < high[1]; ++j)
          for (int i = low[0]; i < high[0]; ++i) {
            if (!comes_in_at(parameters_, grid, number, {i, j, k})) continue;
            const std::size_t cell = grid.index(i, j, k);
            inflow_.push_back({.axis = a,
                               .face = cell + static_cast<std::size_t>(side * grid.stride(axis)),
                               .cell = cell,
                               .row = static_cast<std::size_t>(k * grid.count[1] + j),
                               .velocity = velocity,
                               .into = (side == 0 ? 1 : -1) * velocity * grid.face_area(axis)});
          }
    }
}

void AirFlow::set_inflow(FaceField& velocity) const {
  if (!comes_in_) return;
  for (const Inflow& in : inflow_) velocity[in.axis][in.face] = in.velocity / void_fraction_[in.axis][in.face];
}

void AirFlow::set_inflow(FaceField& velocity, FaceField& mass) const {
  if (!comes_in_) return;
  set_inflow(velocity);
  for (const Inflow& in : inflow_) mass[in.axis][in.face] = parameters_.density() * in.velocity;
}

/// Drag and pressure on the grains of the half cell next to an inflow, as on those between two cells: the pressure is
/// what keeps the velocity at what comes in.
void AirFlow::exchange_at_inflow(double dt, AirState& state, FaceField& impulse) const {
  if (!comes_in_) return;
  const RowRange own = part_.own_slab();
  const double rho = parameters_.density();
  for (const Inflow& in : inflow_) {
    const auto of = [&](const FaceField& field) { return field[in.axis][in.face]; };
    const double solid = of(solid_fraction_), phi = of(void_fraction_), mass = rho * phi;
    if (in.row < own.begin || in.row >= own.end || !(solid > 0)) continue;
    const coupling::SlipDecay slip = coupling::slip_decay(drag_[in.cell] * dt / mass);
    const double start = of(state.momentum), velocity = in.velocity / phi;
    const double after_drag = coupling::velocity_after_drag(slip.decay, start, 1 / mass, of(grain_velocity_));
    const double gained = (velocity - after_drag) / slip.mean;
    const double lost = coupling::drag_impulse(slip.decay, slip.mean, mass, start / mass - of(grain_velocity_), gained);
    const double by_pressure = grains_share() * gained * mass / pressure_share(phi, grains_share());
    impulse[in.axis][in.cell] += 0.5 * (lost / solid + by_pressure);
    state.drag[in.axis][in.cell] += 0.5 * lost / dt;
  }
}

}  // namespace talus::air
