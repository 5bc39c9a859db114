// SPDX-License-Identifier: Apache-2.0
/// The state of the air between its steps, and the solids in its cells.
#pragma once

#include "numerics/grid/grid.hpp"

namespace talus::air {

/// The grains in the air, cell by cell.
struct Solids {
  CellField fraction;  ///< solid volume over volume, 0 to below 1
  FaceField flux;      ///< by component, of every cell: fraction times the solid's velocity, m/s

  Solids() = default;
  explicit Solids(const Grid& grid) : fraction(grid.cell_field()), flux(grid.face_field()) {}
};

/// The fields of the air.
struct AirState {
  FaceField velocity;         ///< m/s
  FaceField momentum;         ///< rho Phi u, kg/(m^2 s)
  FaceField momentum_before;  ///< at the start of the last step
  CellField pressure;         ///< relative to the surroundings, Pa; mean of the last step
  CellField pressure_before;  ///< of the step before
  FaceField drag;             ///< by component, of every cell: mean of the last step, on the grains, N/m^3; derived
  double last_step = 0;       ///< s; 0 before the first

  AirState() = default;
  explicit AirState(const Grid& grid)
      : velocity(grid.face_field()),
        momentum(grid.face_field()),
        momentum_before(grid.face_field()),
        pressure(grid.cell_field()),
        pressure_before(grid.cell_field()),
        drag(grid.face_field()) {}

  /// Component of the velocity in the middle of a cell, m/s.
  double cell_velocity(const Grid& grid, int axis, std::size_t cell) const {
    const auto& u = velocity[static_cast<std::size_t>(axis)];
    return 0.5 * (u[cell] + u[cell + static_cast<std::size_t>(grid.stride(axis))]);
  }
};

}  // namespace talus::air
