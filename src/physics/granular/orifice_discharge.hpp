// SPDX-License-Identifier: Apache-2.0
/// Analytical estimates of the discharge through a hole.
#pragma once

#include <cmath>
#include <numbers>

namespace talus::granular {

/// Q = C rho_b g^(1/2) (D - k d)^(5/2) through a round hole in a flat bottom, with C = 0.58 and k = 1.5 (spheres),
/// kg/s. Source: Beverloo, Leniger & van de Velde, Chem. Eng. Sci. 15, 260 (1961). Range: D above some 6 d. \param
/// diameter D, m; \param bulk_density rho_b, kg/m^3; \param gravity g, m/s^2; \param grain d, m
inline double orifice_discharge(double diameter, double bulk_density, double gravity, double grain) {
  const double open = diameter - 1.5 * grain;
  return open > 0 ? 0.58 * bulk_density * std::sqrt(gravity) * open * open * std::sqrt(open) : 0;
}

/// The same through a rectangular hole: (4 C/pi) rho_b A (g D_h)^(1/2), A the area that is left without a margin of
/// k d/2 along each edge, D_h = 4 A over its circumference; of a slot that is endless along its length, whose ends have
/// no edges, D_h = 2 (W - k d), Q = 1.04 rho_b g^(1/2) L (W - k d)^(3/2). Source: Nedderman, Tuzun, Savage & Houlsby,
/// Chem. Eng. Sci. 37, 1597 (1982), after Fowler & Glastonbury, Chem. Eng. Sci. 10, 150 (1959). \param length along
/// the hole \param endless whether that is a part of a slot that goes on
inline double rectangular_discharge(double width, double length, bool endless, double bulk_density, double gravity,
                                    double grain) {
  const double edge = 1.5 * grain, w = width - edge, l = endless ? length : length - edge;
  if (!(w > 0 && l > 0)) return 0;
  const double hydraulic_diameter = endless ? 2 * w : 2 * w * l / (w + l);
  return 4 * 0.58 / std::numbers::pi * bulk_density * w * l * std::sqrt(gravity * hydraulic_diameter);
}

/// Factor of that for a cone whose walls make the angle theta with the vertical: (tan theta tan phi)^-0.35 where the
/// cone is steeper than the boundary of the grains at rest, phi = 45 degrees from the horizontal where nothing better
/// is known. Source: Rose & Tanaka, The Engineer 208, 465 (1959), as in Nedderman, Statics and Kinematics of Granular
/// Materials (Cambridge, 1992), section 10.5. \param tangent of theta; \returns 1 for a flatter cone
inline double factor_of_cone(double tangent) {
  return tangent > 0 && tangent < 1 ? std::pow(tangent, -0.35) : 1;
}

}  // namespace talus::granular
