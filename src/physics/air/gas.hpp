// SPDX-License-Identifier: Apache-2.0
/// Dry air as an ideal gas: density, mean free path, and how much more easily a grain moves where the gas is thin.
/// Valid from about 1 Pa to a few bar near room temperature. Yuu & Umekage 2011 print neither density nor viscosity.
#pragma once

#include <cmath>
#include <numbers>

namespace talus::air {

/// Specific gas constant of dry air, J/(kg K).
inline constexpr double gas_constant = 287.05;

/// Density of an ideal gas. \param pressure Pa; \param temperature K; \returns kg/m^3: 1.204 at 101325 Pa, 20 degrees C
constexpr double density(double pressure, double temperature) {
  return pressure / (gas_constant * temperature);
}

/// Volume by which a volume of an isothermal ideal gas shrinks for each Pa that its pressure rises, 1/Pa times the
/// volume: dV = -V dP/P, from P V = const. \param volume m^3; \param pressure absolute, Pa, above 0; \returns m^3/Pa
constexpr double isothermal_compliance(double volume, double pressure) {
  return volume / pressure;
}

/// Mean free path of the molecules, (mu/p) (pi R T/2)^(1/2) (Kennard 1938).
/// \param viscosity Pa s; \param pressure Pa; \param temperature K; \returns m
inline double mean_free_path(double viscosity, double pressure, double temperature) {
  return viscosity / pressure * std::sqrt(0.5 * std::numbers::pi * gas_constant * temperature);
}

/// Slip factor C_c by which Stokes' drag is divided: 1 + Kn (1.257 + 0.4 exp(-1.1/Kn)), Kn = 2 lambda/D (Cunningham
/// 1910, coefficients of Davies 1945). The C_c of Yuu & Umekage 2011, Eq. 20: 1.0 for 200 um at 101325 Pa, about 12 at
/// 10 Pa.
/// \param mean_free_path, diameter m
inline double slip_factor(double mean_free_path, double diameter) {
  const double knudsen = 2 * mean_free_path / diameter;
  return knudsen > 0 ? 1 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen)) : 1;
}

}  // namespace talus::air
