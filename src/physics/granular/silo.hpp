// SPDX-License-Identifier: Apache-2.0
/// Analytical estimates for silos: discharge through a hole, and pressures from slices of the bed in balance, the
/// vertical stress taken to be even across each.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::granular {

/// The vertical stress in an upright vessel, Pa: rho_b g L (1 - exp(-z/L)) + q exp(-z/L), L = A/(U mu K).
/// Source: Janssen, Z. Ver. dt. Ing. 39, 1045 (1895); K is the stress on the wall over it. \param weight rho_b g, N/m^3
/// \param length L, m: of a cylinder of diameter D it is D/(4 mu K); infinite on smooth walls \param depth z, m
/// \param surcharge q, at depth 0, Pa
inline double janssen_stress(double weight, double length, double depth, double surcharge = 0) {
  if (std::isinf(length)) return weight * depth + surcharge;
  const double left = std::exp(-depth / length);
  return weight * length * (1 - left) + surcharge * left;
}

/// How a cone carries its load: the stress across its walls over the vertical stress, F, and what follows.
struct ConeBearing {
  double ratio = 0;     ///< F
  double exponent = 0;  ///< n = 2 (F (1 + mu/tan beta) - 1)
};

namespace detail {
inline ConeBearing cone_bearing(double ratio, double half_angle, double friction) {
  return {ratio, 2 * (ratio * (1 + friction / std::tan(half_angle)) - 1)};
}
}  // namespace detail

/// Filled and at rest: the vertical stress grows with the depth as in a liquid, n = 0.
/// Source: Walker, Chem. Eng. Sci. 21, 975 (1966), as in EN 1991-4:2006, 6.3, b = 0. \param half_angle beta from the
/// vertical, rad, 0 to pi/2 \param friction mu of the wall
inline ConeBearing cone_at_rest(double half_angle, double friction) {
  return detail::cone_bearing(1 / (1 + friction / std::tan(half_angle)), half_angle, friction);
}

/// In flow: F = (1 + sin phi cos eps)/(1 - sin phi cos(2 beta + eps)), eps = phi_w + asin(sin phi_w/sin phi), phi_w =
/// atan mu. A wall rougher than the grains counts as rough as they. Source: Walker 1966, as in EN 1991-4:2006, 6.3.
/// \param internal phi, rad, with sin phi the radius of Mohr's circle over its centre: in plane strain
/// (friction_angle.hpp)
inline ConeBearing cone_in_flow(double half_angle, double friction, double internal) {
  const double wall = std::min(std::atan(friction), internal);
  const double turned = wall + std::asin(std::clamp(std::sin(wall) / std::sin(internal), 0.0, 1.0));
  return detail::cone_bearing(
      (1 + std::sin(internal) * std::cos(turned)) / (1 - std::sin(internal) * std::cos(2 * half_angle + turned)),
      half_angle, friction);
}

/// The largest half angle of a cone, from the vertical, in which all grains move while it empties, rad: pi/2 -
/// acos((1 - sin phi)/(2 sin phi))/2 - (phi_w + asin(sin phi_w/sin phi))/2. Farther from the vertical there is no
/// stress field of the whole cone in flow, and grains at its wall stay. Source: Jenike, Bull. 108, Univ. of Utah Eng.
/// Exp. Stn. (1961), in closed form as in Leung et al., J. Pharm. Sci. 108, 464 (2019), Eqs 5 and 6. \param friction of
/// the wall \param internal phi, Jenike's delta, rad, as of cone_in_flow; the form holds from 19.5 degrees on
/// \returns 0 if there is no such cone
inline double mass_flow_half_angle(double friction, double internal) {
  const double wall = std::min(std::atan(friction), internal), sine = std::sin(internal);
  const double turned = wall + std::asin(std::clamp(std::sin(wall) / sine, 0.0, 1.0));
  const double largest = 0.5 * (std::numbers::pi - std::acos(std::clamp((1 - sine) / (2 * sine), 0.0, 1.0)));
  return std::max(0.0, largest - 0.5 * turned);
}

/// The vertical stress in a cone, Pa: that of slices, dp/dx = n p/x - rho_b g, x the height above the apex.
/// Source: Walker 1966. \param height x of the position, > 0 \param top x of the bed's top or of the cone's, m
/// \param surcharge vertical stress there, Pa
inline double cone_stress(const ConeBearing& bearing, double weight, double height, double top, double surcharge) {
  const double share = height / top, n = bearing.exponent, power = std::pow(share, n);
  const double own = std::abs(n - 1) < 1e-9 ? -share * std::log(share) : (share - power) / (n - 1);
  return weight * top * own + surcharge * power;
}

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
