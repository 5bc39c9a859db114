// SPDX-License-Identifier: Apache-2.0
/// Discharge through a hole by the hand formula, to stand beside a computed one.
#pragma once

#include <cmath>

namespace talus::granular {

/// Q = C rho_b g^(1/2) (D - k d)^(5/2) through a round hole in a flat bottom, with C = 0.58 and k = 1.5 (spheres),
/// kg/s. Source: Beverloo, Leniger & van de Velde, Chem. Eng. Sci. 15, 260 (1961). Range: D above some 6 d. \param
/// diameter D, m; \param bulk_density rho_b, kg/m^3; \param gravity g, m/s^2; \param grain d, m
inline double orifice_discharge(double diameter, double bulk_density, double gravity, double grain) {
  const double open = diameter - 1.5 * grain;
  return open > 0 ? 0.58 * bulk_density * std::sqrt(gravity) * open * open * std::sqrt(open) : 0;
}

/// Factor of that for a cone whose walls make the angle theta with the vertical: (tan theta tan phi)^-0.35 where the
/// cone is steeper than the boundary of the grains at rest, phi = 45 degrees from the horizontal where nothing better
/// is known. Source: Rose & Tanaka, The Engineer 208, 465 (1959), as in Nedderman, Statics and Kinematics of Granular
/// Materials (Cambridge, 1992), section 10.5. \param tangent of theta; \returns 1 for a flatter cone
inline double factor_of_cone(double tangent) {
  return tangent > 0 && tangent < 1 ? std::pow(tangent, -0.35) : 1;
}

}  // namespace talus::granular
