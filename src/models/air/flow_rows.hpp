// SPDX-License-Identifier: Apache-2.0
/// A step of the air, row by row along x. Functions of their own, so that the compiler makes vectors of them; arrays
/// begin with the row's first face or cell. The terms are the laws of physics/air/momentum.hpp and
/// physics/coupling/drag.hpp; what a step does with them: flow.hpp.
#pragma once

#include <cstddef>

#include "base/vector.hpp"

namespace talus::air {

/// What a stage knows of a row of faces but for the pressure.
struct StageRow {
  const double* open;            ///< 1 where the air passes, else 0
  const double* void_fraction;   ///< Phi
  const double* momentum;        ///< rho Phi u at the start of the step, kg/(m^2 s)
  const double* grain_velocity;  ///< u_p, m/s
  const double* convection;      ///< N/m^3
  const double* viscous;         ///< viscous_divergence(), 1/(m s)
  const double *decay, *mean;    ///< coupling::SlipDecay
};

/// Velocity of a stage without pressure: `after_drag` is what the drag leaves of the start's, and conductance that of
/// the pressure. \param grains_share 1 if the grains have a share in the pressure's gradient, that of their volume,
/// else 0 \param per_pressure dt over density times area over distance of the centres
void predict_row(std::ptrdiff_t count, double dt, double rho, double viscosity, double grains_share,
                 double per_pressure, const StageRow& row, double* __restrict after_drag, double* __restrict velocity,
                 double* __restrict conductance);

/// What the pressure does to a row of faces.
struct PressureRow {
  const double* open;
  const double* void_fraction;
  const double* mean;        ///< coupling::SlipDecay
  const double *low, *high;  ///< pressure of the cells on either side, Pa
};

/// velocity -= factor * mean * share/Phi * difference of the pressure, where open.
/// \param factor time over density and distance of the centres
void add_pressure_row(std::ptrdiff_t count, double factor, double grains_share, const PressureRow& row,
                      double* __restrict velocity);

/// Air and grains that pass a row of faces.
struct VolumeFlowRow {
  const double *open, *void_fraction, *velocity, *solid_fraction, *grain_velocity;
};

/// \param mixture 1: volume flow of air and grains; 0: of the air
void find_volume_flow_of_row(std::ptrdiff_t count, double mixture, const VolumeFlowRow& row, double* __restrict flow);

/// What flows in through the faces of cells.
void find_source_of_row(int count, std::ptrdiff_t dy, std::ptrdiff_t dz, const Vector3& area, const double* x,
                        const double* y, const double* z, double* __restrict source);

/// What exchange_momentum knows of a row of faces.
struct ExchangeRow {
  const double *open, *void_fraction, *solid_fraction;
  const double* grain_velocity;
  const double* velocity;      ///< of the air at the end of the step, m/s
  const double* momentum;      ///< at its start
  const double *decay, *mean;  ///< coupling::SlipDecay
  const double* after_drag;    ///< of predict_row
  const double *low, *high;    ///< pressure of the cells on either side, Pa
};

/// \param grains_pressure grains' share of the pressure over the distance of the centres
/// \param received out: impulse of drag and pressure over the solid's volume; \param drag out: N/m^3
void exchange_row(std::ptrdiff_t count, double dt, double rho, double grains_pressure, const ExchangeRow& row,
                  double* __restrict received, double* __restrict drag);

/// Means of two rows.
void average_row(std::ptrdiff_t count, const double* first, const double* second, double* __restrict mean);

}  // namespace talus::air
