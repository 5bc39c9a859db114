// SPDX-License-Identifier: Apache-2.0
/// The loops of a step of the air over the faces or cells of a row along x. They are separate functions so that the
/// compiler vectorises them; arrays begin with the first face or cell of the row. The terms are the laws of
/// physics/air/momentum.hpp and physics/coupling/drag.hpp; flow.hpp describes the step.
#pragma once

#include <cstddef>

#include "base/vector.hpp"
#include "physics/coupling/drag.hpp"

namespace talus::air {

/// Momentum in the middle of a step, and its velocity. \param share of the last change of momentum, that this half step
/// brings again \param before momentum at the start of the last step
void extrapolate_row(std::ptrdiff_t count, double share, double rho, const double* void_fraction,
                     const double* momentum, const double* before, double* __restrict mass,
                     double* __restrict velocity);

/// The pressure of a step as those of the last two lead on to it, and the last in place of the one before.
/// \param ratio of the steps
void lead_on_row(std::ptrdiff_t count, double ratio, double* __restrict pressure, double* __restrict before);

/// Input of a step on a row of faces, except for the pressure.
struct StageRow {
  const double* open;            ///< 1 where air can pass, else 0
  const double* void_fraction;   ///< Phi
  const double* momentum;        ///< rho Phi u at the start of the step, kg/(m^2 s)
  const double* grain_velocity;  ///< u_p, m/s
  const double* convection;      ///< N/m^3
  const double* viscous;         ///< viscous_divergence(), 1/(m s)
  const double *decay, *mean;    ///< coupling::SlipDecay
};

/// Velocity of a step without the pressure; `after_drag` is the initial velocity after the drag alone, `conductance`
/// the volume flow per pressure difference. \param grains_share 1 if the pressure gradient acts on the grains by their
/// volume fraction (model A), else 0 \param per_pressure dt / density * face area / distance of the cell centres
void predict_row(std::ptrdiff_t count, double dt, double rho, double viscosity, double grains_share,
                 double per_pressure, const StageRow& row, double* __restrict after_drag, double* __restrict velocity,
                 double* __restrict conductance);

/// Input of the pressure term on a row of faces.
struct PressureRow {
  const double* open;
  const double* void_fraction;
  const double* mean;        ///< coupling::SlipDecay
  const double *low, *high;  ///< pressure of the cells on either side, Pa
};

/// velocity -= factor * mean * share/Phi * pressure difference, where open.
/// \param factor time / (density * distance of the cell centres)
void add_pressure_row(std::ptrdiff_t count, double factor, double grains_share, const PressureRow& row,
                      double* __restrict velocity);

/// Input of the volume flow through the faces of a row of cells, by axis, from the low face of the first cell on.
struct VolumeFlowRow {
  struct Axis {
    const double *open, *open_after, *void_fraction, *velocity, *solid_fraction, *grain_velocity;
    std::ptrdiff_t next;  ///< to the high face of a cell
    double area;          ///< m^2
  };
  Axis axis[3];
};

/// Net volume flow into each cell of a row, of air and grains or of the air alone, m^3/s. \returns the largest sum of
/// the sizes of the flows through the low faces of a cell
double find_source_of_row(int count, bool with_grains, const VolumeFlowRow& row, double* __restrict source);

/// Input of the momentum exchange on a row of faces.
struct ExchangeRow {
  const double *open, *void_fraction, *solid_fraction;
  const double* grain_velocity;
  const double* momentum;      ///< at the start of the step, kg/(m^2 s)
  const double *decay, *mean;  ///< coupling::SlipDecay
  const double* after_drag;    ///< of predict_row
  const double* velocity;      ///< without pressure, m/s
  const double *low, *high;    ///< pressure of the cells on either side, Pa
};

/// What the pressure does in add_pressure_row(), the momentum that follows, and what the grains receive.
/// \param grains_pressure grains_share / distance of the cell centres
/// \param velocity out: of the air, m/s; \param momentum out: rho Phi u, kg/(m^2 s); \param received out: impulse of
/// drag and pressure per solid volume; \param drag out: N/m^3
void finish_row(std::ptrdiff_t count, double dt, double rho, double factor, double grains_share, double grains_pressure,
                const ExchangeRow& row, double* __restrict velocity, double* __restrict momentum,
                double* __restrict received, double* __restrict drag);

/// What a row of faces has of the two cells next to each, by position of the cells: mean solid and void fractions,
/// velocity of the grains.
struct SolidsRow {
  const double *fraction_before, *fraction_here, *flux_before, *flux_here;
};
void find_solids_of_row(std::ptrdiff_t count, const SolidsRow& row, double* __restrict solid, double* __restrict gap,
                        double* __restrict velocity);

/// Whether all are at least 0 and below 1.
bool are_fractions(std::ptrdiff_t count, const double* fraction);

/// What a row of cells has, with the velocities on the low faces of its cells and the way to their high ones, by axis.
struct CellRow {
  const double* fraction;     ///< solid
  const double* flux[3];      ///< of the grains, m/s
  const double* velocity[3];  ///< of the air, m/s
  std::ptrdiff_t next[3];
};

/// beta of a row of cells, at the slip in their centres, kg/(m^3 s).
void find_drag_of_row(std::ptrdiff_t count, coupling::DragLaw law, const coupling::DragMedium& medium,
                      const CellRow& row, double* __restrict drag);

/// Velocity of the air in the centres of a row of cells against the grains', m/s; 0 where there are none.
/// \param square out: of its size
void find_slip_of_row(std::ptrdiff_t count, const CellRow& row, double* __restrict x, double* __restrict y,
                      double* __restrict z, double* __restrict square);

/// What bounds the step in a cell, 1/s.
struct Rates {
  double crossing;  ///< at which the air crosses it
  /// A bed that dilates draws air through its pores; the pressure that this takes stops it at the rate
  /// beta/(Phi^2 rho_b), whatever the wave length.
  double response;
};
inline Rates larger(const Rates& a, const Rates& b) {
  return {a.crossing > b.crossing ? a.crossing : b.crossing, a.response > b.response ? a.response : b.response};
}
/// The largest of a row of cells. \param per_width 1/m
Rates max_rates_of_row(std::ptrdiff_t count, const Vector3& per_width, double grain_density, const CellRow& row,
                       const double* drag);

/// coupling::SlipDecay on a row of faces, from the drag of the cells next to each. \param per_density dt/rho
void find_decay_of_row(std::ptrdiff_t count, double per_density, const double* drag_before, const double* drag_here,
                       const double* void_fraction, double* __restrict decay, double* __restrict mean);

/// mean := (first + second)/2.
void average_row(std::ptrdiff_t count, const double* first, const double* second, double* __restrict mean);

}  // namespace talus::air
