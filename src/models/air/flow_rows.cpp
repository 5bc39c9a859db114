// SPDX-License-Identifier: Apache-2.0
#include "models/air/flow_rows.hpp"

#include "base/clones.hpp"
#include "physics/air/momentum.hpp"
#include "physics/coupling/drag.hpp"

namespace talus::air {

TALUS_CLONES void extrapolate_row(std::ptrdiff_t count, double share, double rho, const double* void_fraction,
                                  const double* momentum, const double* before, double* __restrict mass,
                                  double* __restrict velocity) {
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double middle = momentum[f] + share * (momentum[f] - before[f]);
    mass[f] = middle;
    velocity[f] = middle / (rho * void_fraction[f]);
  }
}

TALUS_CLONES void predict_row(std::ptrdiff_t count, double dt, double rho, double viscosity, double grains_share,
                              double per_pressure, const StageRow& given, double* __restrict after_drag,
                              double* __restrict velocity, double* __restrict conductance) {
  const StageRow row = given;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double phi = row.void_fraction[f], per_mass = 1 / (rho * phi);
    const double force = row.convection[f] + viscous_force(phi, viscosity, row.viscous[f]);
    after_drag[f] =
        row.open[f] * coupling::velocity_after_drag(row.decay[f], row.momentum[f], per_mass, row.grain_velocity[f]);
    velocity[f] = row.open[f] * (after_drag[f] + row.mean[f] * dt * force * per_mass);
    conductance[f] = row.open[f] * pressure_share(phi, grains_share) * row.mean[f] * per_pressure;
  }
}

TALUS_CLONES void add_pressure_row(std::ptrdiff_t count, double factor, double grains_share, const PressureRow& given,
                                   double* __restrict velocity) {
  const PressureRow row = given;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double phi = row.void_fraction[f];
    velocity[f] -=
        factor * row.open[f] * row.mean[f] * (pressure_share(phi, grains_share) / phi) * (row.high[f] - row.low[f]);
  }
}

TALUS_CLONES void find_volume_flow_of_row(std::ptrdiff_t count, double mixture, const VolumeFlowRow& given,
                                          double* __restrict flow) {
  const VolumeFlowRow row = given;
  for (std::ptrdiff_t f = 0; f < count; ++f)
    flow[f] = row.open[f] *
              (row.void_fraction[f] * row.velocity[f] + mixture * row.solid_fraction[f] * row.grain_velocity[f]);
}

TALUS_CLONES void find_source_of_row(int count, std::ptrdiff_t dy, std::ptrdiff_t dz, const Vector3& area,
                                     const double* x, const double* y, const double* z, double* __restrict source) {
  for (int c = 0; c < count; ++c)
    source[c] = -((x[c + 1] - x[c]) * area.x + (y[c + dy] - y[c]) * area.y + (z[c + dz] - z[c]) * area.z);
}

TALUS_CLONES void exchange_row(std::ptrdiff_t count, double dt, double rho, double grains_pressure,
                               const ExchangeRow& given, double* __restrict received, double* __restrict drag) {
  const ExchangeRow row = given;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double mass = rho * row.void_fraction[f], solid = row.solid_fraction[f];
    // All but drag, as an acceleration times dt: what makes the slip's decay end at the velocity found.
    const double gained = (row.velocity[f] - row.after_drag[f]) / row.mean[f];
    const double slip = row.momentum[f] / mass - row.grain_velocity[f];
    const double lost = coupling::drag_impulse(row.decay[f], row.mean[f], mass, slip, gained);
    const double is_solid = solid > 0 ? 1.0 : 0.0;
    const double by_pressure = grains_pressure * dt * (row.high[f] - row.low[f]);
    received[f] = row.open[f] * (is_solid * lost / (solid + (1 - is_solid)) - by_pressure);
    drag[f] = row.open[f] * is_solid * lost / dt;
  }
}

TALUS_CLONES void average_row(std::ptrdiff_t count, const double* first, const double* second,
                              double* __restrict mean) {
  for (std::ptrdiff_t c = 0; c < count; ++c) mean[c] = 0.5 * (first[c] + second[c]);
}

}  // namespace talus::air
