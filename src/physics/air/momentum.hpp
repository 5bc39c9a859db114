// SPDX-License-Identifier: Apache-2.0
/// The terms of the air's momentum balance on a grid, Yuu & Umekage 2011, Eq. 18: what a flow carries through a face,
/// and the viscous force.
#pragma once

namespace talus::air {

/// Velocity that a flow carries through a face between two places of it, from the two on either side.
/// Where all four may be used: (7 (u_l + u_r) - (u_ll + u_rr))/12, the fourth-order central scheme of the paper (for a
/// uniform flow the difference of two faces is the five-point derivative). Next to walls: (u_l + u_r)/2.
/// completed: `upwind` adds upstream weight: 0 the printed scheme, 1 the third-order upstream-biased one (next to walls
/// the upstream value itself).
/// \param u_ll, u_l, u_r, u_rr velocities in the order of the axis, m/s
/// \param wide 1 or 0: whether the outer two may be used; \param direction the sign of the flow, 1 or -1
/// \param upwind 0 to 1
constexpr double carried_velocity(double u_ll, double u_l, double u_r, double u_rr, double wide, double direction,
                                  double upwind) {
  const double middle = 0.5 * (u_l + u_r), jump = u_r - u_l;
  const double outer = (u_l + u_r - u_ll - u_rr) * (1.0 / 12.0);
  const double bend = (u_rr - 3 * jump - u_ll) * (1.0 / 12.0);
  return middle + wide * outer + upwind * direction * (wide * bend - (1 - wide) * 0.5 * jump);
}

/// Viscous force on the air in a volume of grains and air, Eq. 18: Phi mu (laplacian u + grad(div u)/3).
/// Not a divergence: where Phi varies it does not conserve momentum.
/// \param void_fraction Phi; \param viscosity Pa s; \param laplacian, gradient_of_divergence of the velocity, 1/(m s)
/// \returns N/m^3
constexpr double viscous_force(double void_fraction, double viscosity, double laplacian,
                               double gradient_of_divergence) {
  return void_fraction * viscosity * (laplacian + gradient_of_divergence / 3);
}

}  // namespace talus::air
