// SPDX-License-Identifier: Apache-2.0
/// A single sphere in a viscous fluid at rest: Stokes' drag. Valid at Reynolds numbers far below 1, far from walls.
/// Source: Stokes 1851; Niiya, Awazu & Nishimori 2020, Eqs 3a, 4a and 5b.
#pragma once

#include <numbers>

namespace talus::hydrodynamics {

/// Velocity of a sphere over the force on it, 1/(6 pi mu a): Eq. 4a's first term.
/// \param radius m; \param viscosity dynamic, Pa s; \returns m/(N s)
constexpr double stokes_mobility(double radius, double viscosity) {
  return 1.0 / (6.0 * std::numbers::pi * viscosity * radius);
}

/// Speed of a single sphere under its weight less buoyancy, Eq. 5b: (2/9) g (rho_p - rho_f) a^2 / mu.
/// \param radius m; \param density_difference particle less fluid, kg/m^3; \param viscosity Pa s
/// \param gravity the part that drives the motion (on an incline without friction g sin(angle), as in Eq. 5b), m/s^2
/// \returns m/s
constexpr double stokes_speed(double radius, double density_difference, double gravity, double viscosity) {
  return 2.0 / 9.0 * gravity * density_difference * radius * radius / viscosity;
}

}  // namespace talus::hydrodynamics
