// SPDX-License-Identifier: Apache-2.0
/// The terms of the air's momentum balance on a grid, Yuu & Umekage 2011, Eq. 18:
///   d(rho Phi u)/dt = -div(rho Phi u u) - Phi grad P + Phi mu (laplacian u + grad(div u)/3) - beta (u - u_p).
/// Convection, pressure and viscosity are here, the drag in physics/coupling/drag.hpp.
#pragma once

namespace talus::air {

/// Velocity advected through a face, interpolated from the two grid points on either side. Where all four may be used:
/// (7 (u_l + u_r) - (u_ll + u_rr))/12, the fourth-order central scheme of the paper (for a uniform flow the difference
/// of two faces is the five-point derivative). Next to walls: (u_l + u_r)/2. completed: `upwind` adds upwind bias: 0 is
/// the printed scheme, 1 the third-order upwind-biased one (next to walls first-order upwind).
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

/// Convective flux of momentum, rho Phi u_n u: its divergence is the convection of Eq. 18.
/// \param mass_flux rho Phi u_n, kg/(m^2 s); \param velocity advected_velocity(), m/s; \returns N/m^2
constexpr double convected_momentum(double mass_flux, double velocity) {
  return mass_flux * velocity;
}

/// Divergence of the viscous stress over the viscosity, laplacian u + grad(div u)/3 (Stokes' hypothesis), next to walls
/// at rest or moving. completed: Eq. 18 does not mention walls.
/// \param third grad(div u)/3; \param held 2 u/dx^2 next to each no-slip wall, dx the width of the cell; \param driven
/// 2 U/dx^2, U the velocity of the wall; \param laplacian of u from neighbours not behind a wall; all 1/(m s)
constexpr double viscous_divergence(double third, double held, double driven, double laplacian) {
  return third - held + driven + laplacian;
}

/// Viscous force on the air in a volume of grains and air, Eq. 18: Phi mu (laplacian u + grad(div u)/3).
/// Not a divergence: where Phi varies it does not conserve momentum.
/// \param void_fraction Phi; \param viscosity Pa s; \param divergence viscous_divergence(), 1/(m s); \returns N/m^3
constexpr double viscous_force(double void_fraction, double viscosity, double divergence) {
  return viscosity * void_fraction * divergence;
}

/// Fraction of the pressure gradient that acts on the air: Phi in Eq. 18 as printed (model A), 1 in model B.
/// \param void_fraction Phi; \param grains_share 1 if the rest acts on the grains, 0 if nothing does
constexpr double pressure_share(double void_fraction, double grains_share) {
  return void_fraction + (1 - grains_share) * (1 - void_fraction);
}

}  // namespace talus::air
