// SPDX-License-Identifier: Apache-2.0
/// Analytical estimates of pressures in silos: slices of the bed in balance, the vertical
/// stress taken to be even across each.
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

/// How a cone bears: the stress across its walls over the vertical stress, F, and what follows.
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
/// Source: Walker 1966. \param height x of the place, > 0 \param top x of the bed's top or of the cone's, m
/// \param surcharge vertical stress there, Pa
inline double cone_stress(const ConeBearing& bearing, double weight, double height, double top, double surcharge) {
  const double share = height / top, n = bearing.exponent, power = std::pow(share, n);
  const double own = std::abs(n - 1) < 1e-9 ? -share * std::log(share) : (share - power) / (n - 1);
  return weight * top * own + surcharge * power;
}

}  // namespace talus::granular
