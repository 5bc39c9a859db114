// SPDX-License-Identifier: Apache-2.0
#include "physics/hydrodynamics/rotne_prager.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/hydrodynamics/mobility_names.hpp"
#include "physics/hydrodynamics/stokes.hpp"

namespace talus::hydrodynamics {
namespace {

TEST(Stokes, SpeedIsWeightTimesMobility) {
  // The paper's grains of 5 mm on an incline of 45 degrees: weight less buoyancy, Eq. 1, over 6 pi mu a, Eq. 4a.
  const double a = 5e-3, difference = 20 - 1.2, gravity = 9.81 * std::sqrt(0.5), viscosity = 1.82e-5;
  const double weight = 4.0 / 3.0 * std::numbers::pi * a * a * a * difference * gravity;
  EXPECT_NEAR(stokes_speed(a, difference, gravity, viscosity) / (weight * stokes_mobility(a, viscosity)), 1, 1e-14);
  // 1 ms is 7.96 of the paper's units of time a/v_s.
  EXPECT_NEAR(1e-3 * stokes_speed(a, difference, gravity, viscosity) / a, 7.96, 0.005);
}

TEST(Mobility, HasTheCaseFilesNames) {
  EXPECT_EQ(choice_name(Mobility::rotne_prager_1969), "rotne-prager-1969");
  EXPECT_EQ(choice_name(Mobility::zuk_2014), "zuk-2014");
  EXPECT_EQ(choice_name(Mobility::none), "none");
}

/// Eq. 3c, component by component: J_kl(r), r = r_i - r_j.
double printed(int k, int l, const double (&r)[3], double a_j) {
  const double distance = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  const double unit = k == l ? 1 : 0, rr = r[k] * r[l] / (distance * distance), ratio = a_j / distance;
  return (unit + rr + 2.0 / 3.0 * ratio * ratio * (unit - 3 * rr)) / distance;
}

TEST(RotnePrager1969, IsThePrintedTensorEquation3c) {
  const double r[3] = {1.7, -0.4, 2.3}, a_i = 0.6, a_j = 1.1;
  const double inverse = 1 / std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  for (const double source : {a_i, a_j}) {
    const auto m = rotne_prager_1969(inverse, source_size(source));
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        EXPECT_NEAR((k == l ? m.isotropic : 0) + m.radial * r[k] * r[l], printed(k, l, r, source), 1e-15);
  }
}

TEST(RotnePrager1969, IsAsymmetricForUnequalRadiiAsPrinted) {
  // Along the line of centres the two mobilities differ by -4/3 (a_j^2 - a_i^2)/r^3, across it by half as much.
  const double r = 2.5, a_i = 1.05, a_j = 0.95;
  const auto of_i = rotne_prager_1969(1 / r, source_size(a_j)), of_j = rotne_prager_1969(1 / r, source_size(a_i));
  const double difference = (a_j * a_j - a_i * a_i) / (r * r * r);
  EXPECT_NEAR(of_i.isotropic - of_j.isotropic, 2.0 / 3.0 * difference, 1e-16);
  EXPECT_NEAR((of_i.isotropic + of_i.radial * r * r) - (of_j.isotropic + of_j.radial * r * r), -4.0 / 3.0 * difference,
              1e-16);
}

TEST(RotnePrager1969, IsNotFiniteAtOnePlace) {
  EXPECT_FALSE(std::isfinite(rotne_prager_1969(1 / 0.0, source_size(1.0)).isotropic));
}

}  // namespace
}  // namespace talus::hydrodynamics
