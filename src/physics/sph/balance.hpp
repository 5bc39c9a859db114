// SPDX-License-Identifier: Apache-2.0
/// Conservation of mass and momentum between two lumps of the continuum: the terms of one neighbour.
/// Source: Yuu & Umekage 2011, Eqs 16 and 17; Monaghan 1992, Eqs 2.17 and 3.3.
#pragma once

#include <array>
#include <string_view>

#include "base/parameter.hpp"
#include "base/tensor.hpp"
#include "base/vector.hpp"

namespace talus::sph {

/// Eq. 16, d rho/dt = -div(rho u) + u . grad rho, in the form whose sum is the rate of the kernel density:
/// the term of j is m_j (u_i - u_j) . grad W_ij.
/// \param mass m_j, kg; \param slope F_ij, 1/m^5; \param d x_j - x_i, m; \param du u_j - u_i, m/s; \returns kg/(m^3 s)
constexpr double density_rate(double mass, double slope, const Vector3& d, const Vector3& du) {
  return mass * slope * dot(du, d);
}

/// The factor before the stress in Eq. 17.
enum class StressForm {
  balanced,  ///< du/dt = -div(tau)/rho_b: the floor carries the bed's weight
  printed    ///< du/dt = -(1-Phi) div(tau)/rho_b: it would carry 1/(1-Phi) times the weight
};

/// What a lump brings to the momentum balance: stress over density squared, times the packing fraction in the printed
/// form (inside the divergence, so that pairs stay balanced). \returns m^5/(kg s^2)
constexpr SymmetricTensor3<> specific_stress(const SymmetricTensor3<>& stress, double density, double packing,
                                             StressForm form) {
  return (form == StressForm::printed ? packing : 1.0) / (density * density) * stress;
}

/// Eq. 17, du/dt = -div(tau)/rho_b, symmetric: the term of j is -m_j (tau_i/rho_i^2 + tau_j/rho_j^2 + Pi I) . grad W_ij,
/// equal and opposite to that of i on j for equal masses.
/// \param mass m_j, kg; \param slope F_ij, 1/m^5; \param d x_j - x_i, m
/// \param s tau_i/rho_i^2 + tau_j/rho_j^2, compression positive; \param viscosity Pi_ij, both m^5/(kg s^2)
/// \returns m/s^2
constexpr Vector3 acceleration(double mass, double slope, const Vector3& d, const SymmetricTensor3<>& s,
                               double viscosity) {
  return mass * slope *
         Vector3{(s.xx + viscosity) * d.x + s.xy * d.y + s.zx * d.z, s.xy * d.x + (s.yy + viscosity) * d.y + s.yz * d.z,
                 s.zx * d.x + s.yz * d.y + (s.zz + viscosity) * d.z};
}

}  // namespace talus::sph

namespace talus {
template <>
inline constexpr auto choices<sph::StressForm> = std::to_array<std::string_view>({"balanced", "printed"});
}  // namespace talus
