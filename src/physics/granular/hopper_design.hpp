// SPDX-License-Identifier: Apache-2.0
/// Jenike's design of hoppers: half angles that empty in mass flow, outlets that no arch spans, ratholes, discharge.
/// SI units, angles in rad, half angles from the vertical; delta is the effective angle of friction, of which
/// sin(delta) is the radius of Mohr's circle in flow over its centre. Sources: Jenike, Storage and Flow of Solids,
/// Bulletin 123 (Utah, 1964), in the closed forms of Arnold, McLean & Roberts, Bulk Solids: Storage, Flow and Handling
/// (TUNRA, 1982). Their print was not at hand; the tests hold them against Rhodes' worked example (chart: flow
/// factor 1.8, outlet 0.16 m) and against their limits.
#pragma once

#include <limits>

#include "physics/granular/critical_state_point.hpp"
#include "physics/granular/shear_cell.hpp"

namespace talus::granular {

enum class HopperShape { wedge, cone };

/// The largest half angle of mass flow. Of a cone mass_flow_half_angle() (silo.hpp); of a wedge, three times as long as
/// wide at least, {exp[3.75 * 1.01^((delta - 30)/10)] - phi_w}/[0.725 (tan delta)^(1/5)] in degrees, within 2 degrees
/// of ter Borg's fit to the same chart from 30 to 70 degrees (test). A wall counts as rough as the grains at most.
/// Range: delta from 30 degrees on, as the charts; below about 22 the wedge's falls under the cone's. Practice takes
/// off 3 degrees. \param friction of the wall
double mass_flow_half_angle(HopperShape shape, double friction, double internal);

/// H, the width of an outlet over the height of its arch's own material, f_c/(rho_b g): 1 + theta/180 degrees of a
/// slot, 2 + theta/60 degrees of a round hole (Jenike 1964, as in Rhodes, Introduction to Particle Technology, 1998).
double outlet_factor(HopperShape shape, double half_angle);

/// ff = Y (1 + sin delta) H/(2 (X - 1) sin theta), the stress that consolidates what flows over the stress on an arch
/// that it would form, with m = 0 (wedge) or 1 (cone), beta = (phi_w + asin(sin phi_w/sin delta))/2,
///     X = 2^m sin delta/(1 - sin delta) [sin(2 beta + theta)/sin theta + 1],
///     Y = {[2 (1 - cos(beta + theta))]^m (beta + theta)^(1 - m) sin theta + sin beta sin^(1 + m)(beta + theta)}
///         /[(1 - sin delta) sin^(2 + m)(beta + theta)].
/// Range: mass flow, delta from 30 degrees on; the published charts end at 1.1, below which no value is returned.
/// Infinite where X <= 1: there is no such stress field.
double flow_factor(HopperShape shape, double half_angle, double friction, double internal);

/// The locus that steady shear under a load leaves, as a shear tester evaluates it (shear_cell.hpp): points tau = M
/// (sigma + a_0 + kappa load), on which pre-shear lies too. Without the strength at rest. \param load Pa, > 0
YieldLocus steady_locus(const CriticalStateParameters& law, double load);

/// The least stress at which the strength of what flows is that of its arch, f_c = sigma_1/ff. Smaller outlets arch.
struct CriticalOutlet {
  double major = 0, strength = 0;  ///< sigma_1, f_c, Pa; 0 where none arches, or all do
  double factor = 0;               ///< ff there; where none arches, of vanishing stress, where all do, of large
  double effective_angle = 0;      ///< delta likewise
  double width = 0;                ///< B = H f_c/(rho_b g), m; infinite where any outlet arches
  double widest = std::numeric_limits<double>::infinity();  ///< m; wider ones arch again, as delta falls with sigma_1
};
/// \param weight rho_b g, N/m^3 \param wall_friction of the hopper
CriticalOutlet critical_outlet(HopperShape shape, double half_angle, double wall_friction,
                               const CriticalStateParameters& law, double weight);

/// The diameter of a channel in funnel flow that would stand empty, m: G(phi_t) f_c(sigma_1)/(rho_b g), G = 4.3
/// tan(phi_t) within 4 % of the curve in Schulze, Powders and Bulk Solids (2008), Fig. 10.19, from 30 to 70 degrees.
/// \param major sigma_1 that consolidated it, Pa: an upper bound is the largest vertical stress in the silo
double rathole_diameter(const CriticalStateParameters& law, double major, double weight);

/// rho_b A {B g/[2 (1 + m) tan theta]}^(1/2), kg/s, of coarse grains in mass flow; of cohesive ones, times (1 -
/// ff/ff_a)^ (1/2), ff_a the flow factor of the outlet as it is, B/(critical B) times ff. Source: Johanson, Trans. AIME
/// 232, 69 (1965). \param length of a slot, m
double johanson_discharge(HopperShape shape, double half_angle, double width, double length, double bulk_density,
                          double gravity, double critical_width = 0);

/// The same of fine grains in a cone, which air that must enter holds back: rho_b A v, 4 v^2 sin(theta)/B + 15 rho_a^
/// (1/3) mu_a^(2/3) v^(4/3)/(rho_p d^(5/3)) = g. Source: Carleton, Powder Technol. 6, 91 (1972). Air at 20 degrees and
/// 1013 hPa. Range: grains that do not stick together, none of 1 mm and more.
double carleton_discharge(double half_angle, double width, double bulk_density, double gravity, double grain_density,
                          double grain_diameter);

}  // namespace talus::granular
