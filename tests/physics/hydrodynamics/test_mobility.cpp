// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "physics/hydrodynamics/mobility.hpp"
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

// The law against what it stands for: the Oseen tensor averaged over the surfaces of both spheres. The average over
// sphere j is known in closed form (Stokes' flow of a uniform surface force: the Oseen field with the a_j^2/6
// correction outside, a uniform velocity inside); that over sphere i is done here by quadrature.

namespace {

/// Gauss-Legendre points and weights on [-1, 1] (Newton's method on the Legendre polynomial).
struct Quadrature {
  std::vector<double> point, weight;
  explicit Quadrature(int n) {
    for (int k = 1; k <= n; ++k) {
      double x = std::cos(std::numbers::pi * (k - 0.25) / (n + 0.5)), slope = 1;
      for (int iteration = 0; iteration < 20; ++iteration) {
        double p = 1, before = 0;
        for (int m = 1; m <= n; ++m) {
          const double next = ((2 * m - 1) * x * p - (m - 1) * before) / m;
          before = p, p = next;
        }
        slope = n * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      point.push_back(x), weight.push_back(2 / ((1 - x * x) * slope * slope));
    }
  }
};

struct Components {
  double along, across;  ///< 8 pi mu times the mobility along and across the line of centres
};

Components averaged_over_both_surfaces(double r, double a_i, double a_j) {
  static const Quadrature gauss(40);
  // Cosine at which the surface of i passes through that of j; the integrand has a kink there.
  const double crossing = r > 0 ? (a_j * a_j - r * r - a_i * a_i) / (2 * r * a_i) : 2;
  Components sum{0, 0};
  auto add = [&](double from, double to, bool inside) {
    for (std::size_t k = 0; k < gauss.point.size(); ++k) {
      const double c = 0.5 * (from + to) + 0.5 * (to - from) * gauss.point[k];
      const double weight = 0.25 * (to - from) * gauss.weight[k];  // of dc/2
      const double z = r + a_i * c, rho_square = a_i * a_i * (1 - c * c), square = z * z + rho_square;
      if (inside) {
        sum.along += weight * 4 / (3 * a_j), sum.across += weight * 4 / (3 * a_j);
      } else {
        const double inverse = 1 / std::sqrt(square), cube = inverse / square, third = a_j * a_j / 3;
        const double isotropic = inverse + third * cube, radial = cube - 3 * third * cube / square;
        sum.along += weight * (isotropic + radial * z * z);
        sum.across += weight * (isotropic + radial * rho_square / 2);  // mean over the angle about the axis
      }
    }
  };
  if (crossing <= -1 || crossing >= 1) {
    add(-1, 1, r + a_i <= a_j || (crossing >= 1 && r < a_j));
  } else {
    add(-1, crossing, true);
    add(crossing, 1, false);
  }
  return sum;
}

Components law(double r, double a_i, double a_j) {
  const auto m = zuk_2014(r * r, 1 / r, a_i, a_j);
  return {m.isotropic + m.radial * r * r, m.isotropic};
}

TEST(Zuk2014, IsTheOseenTensorAveragedOverBothSurfaces) {
  for (const double a_i : {0.3, 0.95, 1.0})
    for (const double a_j : {1.0, 1.05, 2.0})
      for (const double r : {0.01, 0.1, 0.5, 0.69, 0.71, 0.99, 1.01, 1.29, 1.31, 1.7, 1.999, 2.001, 2.2, 3.1, 7.0}) {
        const Components expected = averaged_over_both_surfaces(r, a_i, a_j), m = law(r, a_i, a_j);
        EXPECT_NEAR(m.along, expected.along, 1e-12) << r << " " << a_i << " " << a_j;
        EXPECT_NEAR(m.across, expected.across, 1e-12) << r << " " << a_i << " " << a_j;
        const Components swapped = law(r, a_j, a_i);
        EXPECT_EQ(m.along, swapped.along);
        EXPECT_EQ(m.across, swapped.across);
      }
}

TEST(Zuk2014, IsContinuousWhereSpheresTouchAndWhereOneLeavesTheOther) {
  for (const auto& [a_i, a_j] : {std::pair{1.0, 1.0}, {0.95, 1.05}, {0.2, 3.0}})
    for (const double r : {a_i + a_j, a_j - a_i}) {
      if (r == 0) continue;
      const double step = 1e-9 * r;
      const Components below = law(r - step, a_i, a_j), above = law(r + step, a_i, a_j);
      EXPECT_NEAR(below.along, above.along, 1e-8 * above.along);
      EXPECT_NEAR(below.across, above.across, 1e-8 * above.across);
    }
}

TEST(Zuk2014, IsStokesMobilityOfTheLargerSphereWhereItHoldsTheOther) {
  for (const double r : {0.0, 1e-300, 1e-160, 1e-20, 0.3, 0.7}) {
    const auto m = zuk_2014(r * r, 1 / std::sqrt(r * r), 0.3, 1.0);
    EXPECT_NEAR(m.isotropic, 4.0 / 3.0, 1e-15) << r;
    EXPECT_EQ(m.radial, 0) << r;
  }
  // Equal spheres: one at the place of the other, however that is approached.
  for (const double r : {0.0, 1e-300, 1e-160, 1e-20, 1e-12}) {
    const auto m = zuk_2014(r * r, 1 / r, 1.0, 1.0);
    EXPECT_NEAR(m.isotropic, 4.0 / 3.0, 1e-11) << r;
    EXPECT_LE(m.radial * r * r, 1e-11) << r;
  }
}

TEST(Zuk2014, IsThePrintedTensorForEqualSpheresApart) {
  const double r = 2.4;
  const auto m = zuk_2014(r * r, 1 / r, 1.0, 1.0), printed = rotne_prager_1969(1 / r, source_size(1.0));
  EXPECT_NEAR(m.isotropic, printed.isotropic, 1e-16);
  EXPECT_NEAR(m.radial, printed.radial, 1e-16);
}

}  // namespace

}  // namespace talus::hydrodynamics
