// SPDX-License-Identifier: Apache-2.0
/// Weight of a sphere in a fluid, less its buoyancy, in the axes of an incline: x down the slope, y across, z away from
/// it. Source: Niiya, Awazu & Nishimori 2020, Eqs 1a-1c.
#pragma once

#include <cmath>
#include <numbers>

#include "base/vector.hpp"

namespace talus::hydrodynamics {

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
