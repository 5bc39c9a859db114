// SPDX-License-Identifier: Apache-2.0
/// A single sphere in a viscous fluid at rest: weight less buoyancy, in the axes of an incline (x down the slope, y
/// across, z away from it), and Stokes' drag. Valid at Reynolds numbers far below 1, far from walls.
/// Source: Stokes 1851; Niiya, Awazu & Nishimori 2020, Eqs 1a-1c, 3a, 4a and 5b.
#pragma once

#include <cmath>
#include <numbers>

#include "base/vector.hpp"

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

/// Volume of a sphere, Eq. 1c. \param radius m; \returns m^3
constexpr double sphere_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// Direction of gravity in the axes of an incline, Eq. 1a: the paper's F^g e_theta with F^g < 0 points down the slope
/// and into it. \param angle of the incline, rad
inline Vector3 downhill(double angle) {
  return {std::sin(angle), 0.0, -std::cos(angle)};
}

/// Size of the weight less the buoyancy, Eq. 1b without its sign; negative for a sphere lighter than the fluid.
/// \param radius m; \param particle_density, fluid_density kg/m^3; \param gravity m/s^2; \returns N
constexpr double buoyant_weight(double radius, double particle_density, double fluid_density, double gravity) {
  return sphere_volume(radius) * gravity * (particle_density - fluid_density);
}

}  // namespace talus::hydrodynamics
