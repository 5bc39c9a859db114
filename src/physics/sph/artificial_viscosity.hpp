// SPDX-License-Identifier: Apache-2.0
/// Monaghan's viscosity: a pressure between particles that approach each other, against the unphysical part of their
/// motion. Source: Monaghan 1992, Eqs 4.1-4.2; named by Yuu & Umekage 2011, section 2.1, without its coefficients.
/// Range: alpha = 0.01-0.1. In a bed of 1226 Pa at 100 m/s, alpha = 1 would add up to 850 Pa of false stress.
#pragma once

#include "base/simd.hpp"

namespace talus::sph {

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

}  // namespace talus::sph
