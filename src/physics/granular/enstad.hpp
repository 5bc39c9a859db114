// SPDX-License-Identifier: Apache-2.0
/// Pressures in a hopper in flow from layers between circular arcs: the major principal stress follows the arcs, which
/// arch from wall to wall, and the minor one presses evenly on each. Layers of Walker (silo.hpp) are level instead, and
/// the vertical stress is even across them.
///
/// At the wall Mohr's circle of the centre p and the radius p sin delta carries Coulomb's friction where the major
/// principal stress makes the angle beta = (phi_w + asin(sin phi_w/sin delta))/2 with the wall's normal. Arcs then span
/// 2 (beta + theta), theta the half angle of the hopper. Their stress p (1 - sin delta) acts on what they cover from
/// above, so that a layer's vertical balance is dp/dr = X p/r - gamma Y along the wall from the apex, with X and Y
/// below: X of the wall's stress, Y of the volume between two arcs.
///
/// Source: G. Enstad, Chem. Eng. Sci. 30, 1273-1283 (1975), second-hand: X and Y as Leung et al., J. Pharm. Sci. 108,
/// 464 (2019), Eqs 19 to 21, print them for cones, as read in github.com/Tornado128/hoppers_performance_checking; the
/// same follow from the balance, and those of wedges. Without cohesion.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "physics/granular/silo.hpp"

namespace talus::granular {

/// How a hopper carries its load in arcs.
struct ArcBearing {
  double exponent = 0;  ///< X: what presses from above falls off as r^X
  double weight = 0;    ///< Y/cos theta: dp/dx = X p/x - gamma Y/cos theta, x the height above the apex
  double on_wall = 0;   ///< stress across the wall over p, 1 + sin delta cos 2 beta
  double on_arc = 0;    ///< stress across the arcs over p, 1 - sin delta
  double cap = 0;       ///< volume between an arc and the level through its ends, over the area there and over x
};

/// Walls rougher than the grains count as rough as they. Of shapes between wedge and cone, Y and the cap are
/// interpolated by S (a choice). \param shape S, 1 of a wedge to 2 of a cone (en1991.hpp) \param half_angle theta, from
/// the vertical, rad, above 0 \param friction mu of the wall \param internal delta, rad, with sin delta the radius of
/// Mohr's circle over its centre, as in cone_in_flow() \returns nothing where an arc would be half a circle or more
inline std::optional<ArcBearing> arc_bearing(double shape, double half_angle, double friction, double internal) {
  const double wall = std::min(std::atan(friction), internal), sine = std::sin(internal);
  const double beta = 0.5 * (wall + std::asin(std::clamp(std::sin(wall) / sine, 0.0, 1.0)));
  const double arc = beta + half_angle, s = std::sin(arc), c = std::cos(arc);
  if (!(arc < 0.5 * std::numbers::pi)) return std::nullopt;
  const double slope = std::sin(half_angle), axial = shape - 1;
  const auto between = [&](double of_wedge, double of_cone) { return (1 - axial) * of_wedge + axial * of_cone; };
  const double of_wedge = (arc * slope + std::sin(beta) * s) / (s * s),
               of_cone = (2 * (1 - c) * slope + std::sin(beta) * s * s) / (s * s * s);
  const double radius = std::tan(half_angle) / s;  // of an arc, over x
  return ArcBearing{.exponent = shape * sine / (1 - sine) * (std::sin(2 * beta + half_angle) / slope + 1),
                    .weight = between(of_wedge, of_cone) / ((1 - sine) * std::cos(half_angle)),
                    .on_wall = 1 + sine * std::cos(2 * beta),
                    .on_arc = 1 - sine,
                    .cap = radius * between((arc - s * c) / (2 * s), (1 - c) * (1 - c) * (2 + c) / (3 * s * s))};
}

/// The stress across the wall of a hopper in flow, Pa. The bed above presses on the arc through the hopper's upper
/// edge; what lies between that arc and the level of the edge weighs below it and not above. \param weight gamma, N/m^3
/// \param height x of the position, > 0 \param top x of the hopper's or the bed's top, m \param surcharge vertical
/// stress at the level of the top, Pa
inline double arc_pressure(const ArcBearing& bearing, double weight, double height, double top, double surcharge) {
  const double above = std::max(0.0, surcharge - weight * bearing.cap * top) / bearing.on_arc;
  return bearing.on_wall *
         cone_stress({.ratio = 1, .exponent = bearing.exponent}, weight * bearing.weight, height, top, above);
}

}  // namespace talus::granular
