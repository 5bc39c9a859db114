// SPDX-License-Identifier: Apache-2.0
/// Conservation of mass and momentum between two particles of the continuum: the terms of one neighbour.
/// Source: Yuu & Umekage 2011, Eqs 16 and 17; Monaghan 1992, Eqs 2.17 and 3.3.
#pragma once

#include "base/simd.hpp"
#include "base/tensor.hpp"

namespace talus::sph {

/// Eq. 16, d rho/dt = -div(rho u) + u . grad rho, in the form whose sum is the rate of the kernel density:
/// the term of j is m_j (u_i - u_j) . grad W_ij.
/// \param mass m_j, kg; \param slope F_ij, 1/m^5; \param d x_j - x_i, m; \param du u_j - u_i, m/s; \returns kg/(m^3 s)
template <class Mass, class Number, class Vector>
constexpr Number density_rate(const Mass& mass, const Number& slope, const Vector& d, const Vector& du) {
  return mass * slope * multiply_add(du.x, d.x, multiply_add(du.y, d.y, du.z * d.z));
}

/// The density after a change in a step: old + change; where it falls, old/(1 + x + x^2) with x = -change/old, which is
/// old (1 - x + x^3 - ...) and positive for any x: a particle that a stream loses may thin by more than its density
/// within one step. \param old, change kg/m^3
constexpr double density_after(double old, double change) {
  if (change >= 0) return old + change;
  const double x = -change / old;
  return old / (1 + x + x * x);
}

/// By how much a shear strain draws a density to the kernel's sum, in a step by the implicit Euler method.
/// \param strain shear strain of the step times the share that a strain of 1 takes back
constexpr double density_towards(double sum, double density, double strain) {
  return strain / (1 + strain) * (sum - density);
}

/// Eq. 17, du/dt = -div(tau)/rho_b, symmetric: the term of j is -m_j (tau_i/rho_i^2 + tau_j/rho_j^2 + Pi I) . grad
/// W_ij, equal and opposite to that of i on j for equal masses. \param mass m_j, kg; \param slope F_ij, 1/m^5; \param d
/// x_j - x_i, m \param s tau_i/rho_i^2 + tau_j/rho_j^2, compression positive; \param viscosity Pi_ij, both m^5/(kg s^2)
/// \returns m/s^2
template <class Mass, class Number, class Vector>
constexpr Vector acceleration(const Mass& mass, const Number& slope, const Vector& d, const SymmetricTensor3<Number>& s,
                              const Number& viscosity) {
  const Number factor = mass * slope;
  const auto row = [&](const Number& x, const Number& y, const Number& z) {
    return factor * multiply_add(x, d.x, multiply_add(y, d.y, z * d.z));
  };
  return {row(s.xx + viscosity, s.xy, s.zx), row(s.xy, s.yy + viscosity, s.yz), row(s.zx, s.yz, s.zz + viscosity)};
}

// Monaghan's viscosity: a pressure between particles that approach each other, against the unphysical part of their
// motion. Source: Monaghan 1992, Eqs 4.1-4.2; named by Yuu & Umekage 2011, section 2.1, without its coefficients.
// Range: alpha = 0.01-0.1. In a bed of 1226 Pa at 100 m/s, alpha = 1 would add up to 850 Pa of false stress.

struct ArtificialViscosity {
  double alpha = 0.05;  ///< linear part
  double beta = 0;      ///< quadratic part, against interpenetration in impacts
};

/// Pi_ij = (-alpha c mu + beta mu^2)/rho with mu = h (u_i-u_j).(x_i-x_j)/(r^2 + 0.01 h^2) for approaching particles,
/// else 0. \param approach (u_j-u_i).(x_j-x_i), m^2/s; \param distance_squared r^2, m^2; \param h mean smoothing
/// length, m \param sound_speed mean of the two, m/s; \param density mean of the two, kg/m^3; \returns m^5/(kg s^2), >=
/// 0
template <class Number, class Speed>
TALUS_INLINE constexpr Number viscosity(const ArtificialViscosity& law, const Number& approach,
                                        const Number& distance_squared, const Number& h, const Speed& sound_speed,
                                        const Number& density) {
  const Number softened = distance_squared + 0.01 * h * h;
  const Number mu_over_density = h * approach / (softened * density);
  const Number mu = mu_over_density * density;
  return select(approach < Number(0.0), (law.beta * mu - law.alpha * sound_speed) * mu_over_density, Number(0.0));
}

/// Artificial stress of a pair under tension, in place of the viscosity Pi_ij: -epsilon T (f^4 - f^6) with f =
/// W(r)/W(l), l the spacing of the particles at rest. Under tension layers of particles pair up, as their kernel is
/// convex where their neighbours are: the tensile instability. A spring between neighbours holds them apart and
/// together, and a lattice that is not disturbed bears what it bore, to 0.1 % of T. Source: Monaghan, J. Comput. Phys.
/// 159, 290 (2000), and Gray, Monaghan & Swift, Comput. Methods Appl. Mech. Eng. 190, 6641 (2001); deviates: they have
/// f^4, which takes a third of epsilon T from an undisturbed lattice. Range: epsilon from 1 to 4 leaves 2 % of the
/// growth in a cubic lattice. \param tension of the pair, sum of T/rho^2, m^5/(kg s^2); \param nearness f
template <class Number>
TALUS_INLINE constexpr Number artificial_stress(double strength, const Number& tension, const Number& nearness) {
  const Number square = nearness * nearness;
  return strength * tension * (square * square * (square - 1.0));
}

// Terms of a pair that damp what the particles cannot resolve, and leave linear fields as they are: densities that
// alternate from particle to particle, and velocities that do. Both vanish as the spacing does.

/// Diffusion of the density, the term of j in d rho_i/dt:
///     2 delta h c V_j psi_ij . grad W_ij,  psi_ij = [(rho_j - rho_i) - (grad rho_i + grad rho_j) . d/2] d/r^2
/// Source: Antuono, Colagrossi, Marrone & Molteni, Comput. Phys. Commun. 181, 532 (2010), "delta-SPH", delta = 0.1,
/// with corrected gradients of the density, so that a linear field stays. Symmetric but for V_j.
/// \param strength 2 delta c, m/s; \param h mean smoothing length, m; \param volume V_j, m^3; \param slope F_ij, 1/m^5
/// \param d x_j - x_i, m; \param difference rho_j - rho_i, kg/m^3; \param gradients grad rho_i + grad rho_j, kg/m^4
/// \returns kg/(m^3 s)
template <class Number, class Vector>
TALUS_INLINE constexpr Number density_diffusion(double strength, const Number& h, const Number& volume,
                                                const Number& slope, const Vector& d, const Number& difference,
                                                const Vector& gradients) {
  const Number linear = 0.5 * (gradients.x * d.x + gradients.y * d.y + gradients.z * d.z);
  return (-strength) * h * volume * slope * (difference - linear);
}

/// The part of a pair's approach that the gradients of the velocity do not explain, (du - (L_i + L_j) d/2) . d =
/// du . d - d . (D_i + D_j) d/2, m^2/s: zero in any linear field. Its damping is the viscous counterpart of the penalty
/// on non-affine displacements of Ganzenmueller, Comput. Methods Appl. Mech. Eng. 286, 87 (2015); nothing is remembered
/// of a pair.
/// \param approach du . d; \param d x_j - x_i, m; \param rates D_i + D_j, D the symmetric part of L_ij = du_i/dx_j, 1/s
template <class Number, class Vector>
TALUS_INLINE constexpr Number unexplained_approach(const Number& approach, const Vector& d,
                                                   const SymmetricTensor3<Number>& rates) {
  const Number x = rates.xx * d.x + rates.xy * d.y + rates.zx * d.z;
  const Number y = rates.xy * d.x + rates.yy * d.y + rates.yz * d.z;
  const Number z = rates.zx * d.x + rates.yz * d.y + rates.zz * d.z;
  return approach - 0.5 * (x * d.x + y * d.y + z * d.z);
}

/// Pi_ij of that damping, -zeta c h w/((r^2 + 0.01 h^2) rho) for an unexplained approach w: as the linear part of
/// Monaghan's viscosity (`viscosity`), but for w of either sign. \returns m^5/(kg s^2)
template <class Number>
TALUS_INLINE constexpr Number hourglass_damping(double strength, const Number& unexplained,
                                                const Number& distance_squared, const Number& h,
                                                const Number& density) {
  return (-strength) * h * unexplained / ((distance_squared + 0.01 * h * h) * density);
}

}  // namespace talus::sph
