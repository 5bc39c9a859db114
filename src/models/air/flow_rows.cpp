// SPDX-License-Identifier: Apache-2.0
#include "models/air/flow_rows.hpp"

#include "base/clones.hpp"

namespace talus::air {

namespace {

/// Of the pressure's gradient, on air of a void fraction: phi in model A, all of it in model B.
double air_share(double phi, double grains_share) {
  return phi + (1 - grains_share) * (1 - phi);
}

}  // namespace

TALUS_CLONES void move_row(std::ptrdiff_t count, double dt, double rho, double viscosity, double grains_share,
                           double way, const StageRow& row, double* __restrict base, double* __restrict velocity,
                           double* __restrict conductance) {
  const auto [open, phi, momentum, grains, convection, stress, decay, pull] = row;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double per_mass = 1 / (rho * phi[f]);
    const double force = convection[f] + viscosity * phi[f] * stress[f];
    const double carried = open[f] * (decay[f] * momentum[f] * per_mass + (1 - decay[f]) * grains[f]);
    base[f] = carried;
    velocity[f] = open[f] * (carried + pull[f] * dt * force * per_mass);
    conductance[f] = open[f] * air_share(phi[f], grains_share) * pull[f] * way;
  }
}

TALUS_CLONES void press_row(std::ptrdiff_t count, double factor, double grains_share, const double* open,
                            const double* phi, const double* pull, const double* below, const double* above,
                            double* __restrict velocity) {
  for (std::ptrdiff_t f = 0; f < count; ++f)
    velocity[f] -= factor * open[f] * pull[f] * (air_share(phi[f], grains_share) / phi[f]) * (above[f] - below[f]);
}

TALUS_CLONES void find_volume_flow_of_row(std::ptrdiff_t count, double carried, const double* open, const double* phi,
                                          const double* velocity, const double* solid, const double* grains,
                                          double* __restrict flow) {
  for (std::ptrdiff_t f = 0; f < count; ++f)
    flow[f] = open[f] * (phi[f] * velocity[f] + carried * solid[f] * grains[f]);
}

TALUS_CLONES void find_source_of_row(int count, std::ptrdiff_t dy, std::ptrdiff_t dz, const Vector3& area,
                                     const double* x, const double* y, const double* z, double* __restrict source) {
  for (int c = 0; c < count; ++c)
    source[c] = -((x[c + 1] - x[c]) * area.x + (y[c + dy] - y[c]) * area.y + (z[c + dz] - z[c]) * area.z);
}

TALUS_CLONES void hand_over_row(std::ptrdiff_t count, double dt, double rho, double press, const HandOverRow& row,
                                double* __restrict received, double* __restrict drag) {
  const auto [open, solid, phi, grains, velocity, momentum, decay, pull, base, below, above] = row;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double mass = rho * phi[f];
    // All but drag, as an acceleration times dt: what makes the slip's decay end at the velocity found.
    const double push = (velocity[f] - base[f]) / pull[f];
    const double slip = momentum[f] / mass - grains[f];
    const double lost = mass * (slip * (1 - decay[f]) + (1 - pull[f]) * push);
    const double is_solid = solid[f] > 0 ? 1.0 : 0.0;
    received[f] = open[f] * (is_solid * lost / (solid[f] + (1 - is_solid)) - press * dt * (above[f] - below[f]));
    drag[f] = open[f] * is_solid * lost / dt;
  }
}

TALUS_CLONES void average_row(std::ptrdiff_t count, const double* below, const double* above, double* __restrict mean) {
  for (std::ptrdiff_t c = 0; c < count; ++c) mean[c] = 0.5 * (below[c] + above[c]);
}

}  // namespace talus::air
