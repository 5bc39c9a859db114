// SPDX-License-Identifier: Apache-2.0
/// How the bulk density of a material point enters its stress.
/// Source: Yuu & Umekage 2011, section 2.1.
#pragma once

#include "base/simd.hpp"

namespace talus::granular {

/// f(rho_b) of Eqs 1-3, linear, 1 at the packing of the fits: (5/3) rho_b/rho_p.
/// \param packing rho_b/rho_p
template <class Number>
Number density_factor(const Number& packing) {
  return (5.0 / 3.0) * packing;
}

/// The factor [rho_b/(0.5 rho_p)]^96 by which Eqs 1-3 vanish where grains lose contact; 1 above the gate.
/// \param packing rho_b/rho_p; \param gate packing below which the factor acts, 0.5; \param power 96, or any >= 0
template <class Number>
Number contact_gate(const Number& packing, double gate, int power) {
  Number base = minimum(packing * (1.0 / gate), Number(1.0));
  Number result = 1.0;
  for (int left = power; left > 0; left >>= 1) {
    if (left & 1) result = result * base;
    base = base * base;
  }
  return result;
}

/// The volumetric part of the strain, tr(e)/3, from the density: ln(rho_b/rho_ref)/3, positive in compression.
/// deviates: the paper takes it from displacements since the last reset; this cannot drift from the packing.
/// \param packing, reference_packing rho_b/rho_p, rho_ref/rho_p
template <class Number>
Number volumetric_strain(const Number& packing, double reference_packing) {
  using std::log;
  return (1.0 / 3.0) * log(packing * (1.0 / reference_packing));
}

}  // namespace talus::granular
