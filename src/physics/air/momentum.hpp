// SPDX-License-Identifier: Apache-2.0
/// The terms of the air's momentum balance on a grid, Yuu & Umekage 2011, Eq. 18:
///   d(rho Phi u)/dt = -div(rho Phi u u) - Phi grad P + Phi mu (laplacian u + grad(div u)/3) - beta (u - u_p).
/// Convection, pressure and viscosity stand here, the drag in physics/coupling/drag.hpp.
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
constexpr double advected_velocity(double u_ll, double u_l, double u_r, double u_rr, double wide, double direction,
                                   double upwind) {
  const double middle = 0.5 * (u_l + u_r), jump = u_r - u_l;
  const double outer = (u_l + u_r - u_ll - u_rr) * (1.0 / 12.0);
  const double bend = (u_rr - 3 * jump - u_ll) * (1.0 / 12.0);
  return middle + wide * outer + upwind * direction * (wide * bend - (1 - wide) * 0.5 * jump);
}

/// Momentum that a flow carries through a unit area, rho Phi u_n u: its divergence is Eq. 18's convection.
/// \param mass_flux rho Phi u_n, kg/(m^2 s); \param velocity as carried, m/s; \returns N/m^2
constexpr double convected_momentum(double mass_flux, double velocity) {
  return mass_flux * velocity;
}

/// Divergence of the viscous stress over the viscosity, laplacian u + grad(div u)/3 (Stokes' hypothesis), beside walls
/// at rest or moving. completed: Eq. 18 is silent on walls.
/// \param third grad(div u)/3; \param held 2 u/dx^2 beside each rough wall, dx the width of the cell; \param driven
/// 2 U/dx^2, U the wall's velocity; \param laplacian of u from the neighbours that are seen; all 1/(m s)
constexpr double viscous_divergence(double third, double held, double driven, double laplacian) {
  return third - held + driven + laplacian;
}

/// Viscous force on the air in a volume of grains and air, Eq. 18: Phi mu (laplacian u + grad(div u)/3).
/// Not a divergence: where Phi varies it does not conserve momentum.
/// \param void_fraction Phi; \param viscosity Pa s; \param divergence viscous_divergence(), 1/(m s); \returns N/m^3
constexpr double viscous_force(double void_fraction, double viscosity, double divergence) {
  return viscosity * void_fraction * divergence;
}

/// Share of the pressure's gradient that acts on the air: Phi in Eq. 18 as printed (model A), all of it in model B.
/// \param void_fraction Phi; \param grains_share 1 if grains have the share of their volume in it, 0 if none
constexpr double pressure_share(double void_fraction, double grains_share) {
  return void_fraction + (1 - grains_share) * (1 - void_fraction);
}

}  // namespace talus::air
