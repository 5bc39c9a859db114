// SPDX-License-Identifier: Apache-2.0
/// A step of the air, row by row along x. Functions of their own, so that the compiler makes vectors of them; arrays
/// begin with the row's first face or cell. What the terms mean: flow.hpp.
#pragma once

#include <cstddef>

#include "base/vector.hpp"

namespace talus::air {

/// What a stage knows of a row of faces but for the pressure.
struct StageRow {
  const double *open, *phi, *momentum, *grains, *convection, *stress, *decay, *pull;
};

/// Velocity of a stage without pressure: `base` is what is left of the start, and conductance that of the pressure.
/// \param grains_share 1 if the grains have a share in the pressure's gradient, that of their volume, else 0
/// \param way dt over density times area over distance of the centres
void move_row(std::ptrdiff_t count, double dt, double rho, double viscosity, double grains_share, double way,
              const StageRow& row, double* __restrict base, double* __restrict velocity,
              double* __restrict conductance);

/// velocity -= factor * pull * difference of the pressure, where open; 1/phi of it where the grains have no share.
void press_row(std::ptrdiff_t count, double factor, double grains_share, const double* open, const double* phi,
               const double* pull, const double* below, const double* above, double* __restrict velocity);

/// \param carried 1: of air and grains; 0: of the air
void find_volume_flow_of_row(std::ptrdiff_t count, double carried, const double* open, const double* phi,
                             const double* velocity, const double* solid, const double* grains,
                             double* __restrict flow);

/// What flows in through the faces of cells.
void find_source_of_row(int count, std::ptrdiff_t dy, std::ptrdiff_t dz, const Vector3& area, const double* x,
                        const double* y, const double* z, double* __restrict source);

/// What hand_over knows of a row of faces.
struct HandOverRow {
  const double *open, *solid, *phi, *grains, *velocity, *momentum, *decay, *pull, *base, *below, *above;
};

/// \param press grains' share of the pressure over the distance of the centres
/// \param received out: impulse of drag and pressure over the solid's volume; \param drag out: N/m^3
void hand_over_row(std::ptrdiff_t count, double dt, double rho, double press, const HandOverRow& row,
                   double* __restrict received, double* __restrict drag);

/// Means of two rows.
void average_row(std::ptrdiff_t count, const double* below, const double* above, double* __restrict mean);

}  // namespace talus::air
