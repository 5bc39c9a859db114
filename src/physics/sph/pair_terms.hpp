// SPDX-License-Identifier: Apache-2.0
/// Conservation of mass and momentum between two particles of the continuum: the terms of one neighbour.
/// Source: Yuu & Umekage 2011, Eqs 16 and 17; Monaghan 1992, Eqs 2.17 and 3.3.
#pragma once

#include "base/tensor.hpp"

namespace talus::sph {

/// Eq. 16, d rho/dt = -div(rho u) + u . grad rho, in the form whose sum is the rate of the kernel density:
/// the term of j is m_j (u_i - u_j) . grad W_ij.
/// \param mass m_j, kg; \param slope F_ij, 1/m^5; \param d x_j - x_i, m; \param du u_j - u_i, m/s; \returns kg/(m^3 s)
template <class Number, class Vector>
constexpr Number density_rate(double mass, const Number& slope, const Vector& d, const Vector& du) {
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
template <class Number, class Vector>
constexpr Vector acceleration(double mass, const Number& slope, const Vector& d, const SymmetricTensor3<Number>& s,
                              const Number& viscosity) {
  const Number factor = mass * slope;
  const auto row = [&](const Number& x, const Number& y, const Number& z) {
    return factor * multiply_add(x, d.x, multiply_add(y, d.y, z * d.z));
  };
  return {row(s.xx + viscosity, s.xy, s.zx), row(s.xy, s.yy + viscosity, s.yz), row(s.zx, s.yz, s.zz + viscosity)};
}

}  // namespace talus::sph
