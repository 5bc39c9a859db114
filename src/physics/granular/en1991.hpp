// SPDX-License-Identifier: Apache-2.0
/// Loads on silos by EN 1991-4:2006, action assessment classes 2 and 3. SI units, angles in rad. z is the depth below
/// the equivalent surface (the level bed of the same volume), x the height above a hopper's apex. Numbers in brackets
/// are clauses of the code. Its table 3.1 and its formulas are as two public programs have them
/// (github.com/keipalahniuk/silo-calcs, github.com/arturopala/encalmo) and as tests/physics/granular/test_en1991.cpp
/// checks by balance and limits; the print itself was not at hand.
#pragma once

#include "physics/granular/silo.hpp"

namespace talus::granular::en1991 {

/// What the code knows of a solid (its table E.1): means, and the factor between a mean and its upper value.
struct Solid {
  double repose = 0;                         ///< phi_r, rad
  double internal = 0, internal_factor = 1;  ///< phi_im, rad, and a_phi
  double ratio = 0, ratio_factor = 1;        ///< K_m, wall over vertical stress, and a_K
  double friction_factor = 1;                ///< a_mu
  double patch = 1;                          ///< C_op
  double max_weight = 0;                     ///< gamma_u, N/m^3; 0: not known
};

/// K_m = 1.1 (1 - sin phi_im) (4.3.3), phi_r = phi_im up to 45 degrees, and the factors of a solid that the code does
/// not list: 1.3, 1.5, 1.4; C_op = 1. \param internal phi_im, rad
Solid unknown_solid(double internal);

/// What a load is computed for.
enum class Load { wall_pressure, wall_shear, bottom, hopper_filling, hopper_discharge };
enum class Limit { lower, mean, upper };

/// gamma, N/m^3: that of the bed, for upper limits at least gamma_u (table E.1). \param weight of the bed
double weight_for(const Solid& solid, double weight, Limit limit);

/// Wall friction mu, K and phi_i, rad.
struct Values {
  double friction = 0, ratio = 0, internal = 0;
};

/// The values that make a load largest (table 3.1), or, for its lower limit, the opposite ones: a mean times or over
/// its factor; K at most 1, as in a liquid, and no wall rougher than the grains (note to table 3.1): mu at most tan
/// phi_i on the same side of its mean. \param friction mean of the wall
Values values_for(const Solid& solid, double friction, Load load, Limit limit);

/// The part of a silo with upright walls.
struct Silo {
  double area = 0, circumference = 0;  ///< A, m^2, and U, m
  double width = 0;                    ///< d_c, diameter of the circle inscribed, m
  double height = 0;                   ///< h_c, from the equivalent surface to the transition or the flat bottom, m
  bool is_round = true;
  bool has_flat_bottom = true;

  double slenderness() const { return height / width; }
};

/// slender: h_c/d_c >= 2; intermediate: above 1; squat: up to 1; retaining: up to 0.4 on a flat bottom (5.1).
enum class Class { slender, intermediate, squat, retaining };
Class class_of(const Silo& silo);

/// z_o = A/(U K mu), m (5.2.1.1); infinite on a smooth wall.
double characteristic_depth(const Silo& silo, const Values& values);

/// h_o, how far the highest contact with the wall is below the equivalent surface of a central pile, m: d_c/6 tan
/// phi_r, of a rectangular silo d_c/4 tan phi_r (5.3.1.1). 0 in slender silos, where it does not count.
double contact_depth(const Silo& silo, double repose);

/// Symmetrical loads at a depth, Pa.
struct Stresses {
  double pressure = 0, shear = 0, vertical = 0;
};

/// After filling: Janssen's in slender silos (5.2.1.1), else those with Y_R (5.3.1.1), a retaining silo as a
/// squat one. 0 above the highest contact with the wall. \param weight gamma, N/m^3 \param depth z, m
Stresses filling(const Silo& silo, double repose, const Values& values, double weight, double depth);

/// C_h and C_w, discharge over filling: 1.15 and 1.10, 1 + 0.15 C_S and 1 + 0.1 C_S with C_S = h_c/d_c - 1, 1 and 1
/// (5.2.2.1, 5.3.2.1).
struct DischargeFactors {
  double pressure = 1, shear = 1;
};
DischargeFactors discharge_factors(const Silo& silo);

/// Patch load over symmetrical pressure at its place, C_pf (5.2.1.2) and C_pe (5.2.2.2), at least 0. \param
/// eccentricity e_f of the top pile, e_o of the outlet, m
double patch_of_filling(const Silo& silo, double solid_factor, double eccentricity);
double patch_of_discharge(const Silo& silo, double solid_factor, double eccentricity);
/// p_nc/p_p: in place of a patch, the pressure on all sides of a silo that is not round rises by this share of the
/// patch load over that extent (5.17, 5.37).
inline constexpr double patch_of_straight_walls = 0.36;
/// Its extent along the wall, s = pi d_c/16, m (5.2.1.2).
double patch_extent(const Silo& silo);

/// From this eccentricity of the outlet over d_c on, the flow channel counts (5.1).
inline constexpr double large_eccentricity = 0.25;
/// Radii of the channel over the silo's that are tried (5.2.4.3.2).
inline constexpr double channel_radii[] = {0.25, 0.4, 0.6};

/// A flow channel along the wall of a round silo, and the bed outside at rest (5.2.4.3.2).
struct FlowChannel {
  double radius = 0;               ///< r_c, m
  double offset = 0;               ///< e_c, of its axis from the silo's, m
  double half_angle = 0;           ///< theta_c, of the wall that it touches, rad
  double on_wall = 0, on_bed = 0;  ///< U_wc, U_sc, m
  double area = 0;                 ///< A_c, m^2
  double ratio = 0;                ///< K
  double depth = 0;                ///< z_oc, m
};
/// Checked: A_c is the area that two circles share, and pi r_c^2 where the channel only touches the wall (mu = tan
/// phi_i, mu = 0: theta_c = 0). A wall rougher than the grains counts as rough as they. \param share r_c/r, above 0,
/// below 1
FlowChannel flow_channel(double radius, double share, const Values& values);
/// p_hce on the wall of the channel, Pa. Beside it, from theta_c to 2 theta_c, 2 p_hf - p_hce;
/// elsewhere p_hf.
double channel_pressure(const FlowChannel& channel, double weight, double depth);

/// Whether a hopper is steep: tan beta < (1 - K)/(2 mu_h) (6.1.1). \param half_angle beta, from the vertical, rad
bool is_steep(double half_angle, double friction, double ratio);
/// The friction that the hopper's wall mobilises: mu_h if steep, else (1 - K)/(2 tan beta) (6.1.1, 6.3.2).
double hopper_friction(double half_angle, double friction, double ratio);

/// S of a hopper: 2 of cones and square pyramids, 1 of wedges, 1 + b/a of rectangles (6.1.1).
inline constexpr double conical = 2, wedge = 1;
/// Stress across the wall over vertical stress, and the exponent of cone_stress(), after filling: F_f = 1 - 0.2/(1 +
/// tan beta/mu), n = S 0.8 mu/tan beta (6.3.2). mu that of hopper_friction(). \param shape S
ConeBearing hopper_filling(double shape, double half_angle, double friction, double ratio);
/// In discharge: of a steep hopper cone_in_flow() (6.3.3), of a shallow one as after filling. n = S (F (1 +
/// mu/tan beta) - 1), which balances each slice; the code prints S (F (1 + mu/tan beta)) - 2, the same for S = 2.
ConeBearing hopper_discharge(double shape, double half_angle, const Values& values);

/// Vertical pressure on a flat bottom, Pa: p_vf of slender silos; of others p_vsq, with the pile's height h_tp = 3 h_o,
/// of a rectangular silo 2 h_o (6.2).
double bottom_pressure(const Silo& silo, double repose, const Values& values, double weight);

}  // namespace talus::granular::en1991
