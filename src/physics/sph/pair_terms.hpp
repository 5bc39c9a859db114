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

/// Pi_ij = -alpha c mu/rho with mu = h (u_i-u_j).(x_i-x_j)/(r^2 + 0.01 h^2) for approaching particles, else 0; his
/// quadratic part, against interpenetration in impacts, is left out. \param approach (u_j-u_i).(x_j-x_i), m^2/s;
/// \param distance_squared r^2, m^2; \param h mean smoothing length, m; \param sound_speed m/s; \param density mean of
/// the two, kg/m^3; \returns m^5/(kg s^2), >= 0
template <class Number>
TALUS_INLINE constexpr Number viscosity(double alpha, const Number& approach, const Number& distance_squared,
                                        const Number& h, double sound_speed, const Number& density) {
  const Number softened = distance_squared + 0.01 * h * h;
  const Number mu_over_density = h * approach / (softened * density);
  return select(approach < Number(0.0), (-alpha * sound_speed) * mu_over_density, Number(0.0));
}

/// Artificial stress of a pair under tension, in place of the viscosity Pi_ij: -epsilon T (f^4 - f^6) with f =
/// W(r)/W(l), l the spacing of the particles at rest. Under tension layers of particles pair up, as their kernel is
/// convex where their neighbours are: the tensile instability. A spring between neighbours holds them apart and
/// together, and a lattice that is not disturbed bears what it bore, to 0.1 % of T. Source: Monaghan, J. Comput. Phys.
/// 159, 290 (2000), and Gray, Monaghan & Swift, Comput. Methods Appl. Mech. Eng. 190, 6641 (2001); deviates: they have
/// f^4, which takes a third of epsilon T from an undisturbed lattice; and here f^2 is at most 2, as at 0.87 of the
/// spacing. A pair's spring is (6 f^5 - 4 f^3) 2 epsilon T/(K V W(l)) as stiff as its elasticity: 560 epsilon T/K
/// there, 4000 at f = 2, 75000 at 0.3 of the spacing, where copies about a sector's axis meet; the Courant number knows
/// of none. Range: epsilon from 1 to 4 leaves 2 % of the growth in a cubic lattice. \param tension of the pair, sum of
/// T/rho^2, m^5/(kg s^2); \param nearness f
template <class Number>
TALUS_INLINE constexpr Number artificial_stress(double strength, const Number& tension, const Number& nearness) {
  const Number all = nearness * nearness, square = select(all < Number(2.0), all, Number(2.0));
  return strength * tension * (square * square * (square - 1.0));
}

}  // namespace talus::sph
