// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/balance.hpp"
#include "physics/sph/pair_terms.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::sph {
namespace {

constexpr auto push = acceleration<double, double, Vector3>;
constexpr auto rate = density_rate<double, double, Vector3>;
double viscosity_of(double alpha, double approach, double square, double h, double c, double rho) {
  return viscosity(alpha, approach, square, h, c, rho);
}

TEST(Balance, CompressionPushesApartEqualAndOpposite) {
  const SymmetricTensor3<> s{4, 1, 1, 0.5, 0, 0};
  const Vector3 a = push(2, -3, {1, 0, 0}, s, 0.25);
  EXPECT_EQ(a, (Vector3{-2 * 3 * 4.25, -2 * 3 * 0.5, 0}));
  EXPECT_EQ(push(2, -3, {-1, 0, 0}, s, 0.25), -1.0 * a);
}

TEST(Balance, ApproachRaisesTheDensity) {
  EXPECT_GT(rate(2, -3, {1, 0, 0}, {-1, 0, 0}), 0);
  EXPECT_EQ(rate(2, -3, {1, 0, 0}, {0, 5, 0}), 0);
}

TEST(Balance, ThePrintedFormCountsTheStressByThePackingFraction) {
  const SymmetricTensor3<> tau{100, 200, 300, 10, 20, 30};
  const double density = 1500, packing = 0.6;
  EXPECT_DOUBLE_EQ(specific_stress(tau, density, packing, StressForm::balanced).zz, 300 / (1500.0 * 1500));
  EXPECT_DOUBLE_EQ(specific_stress(tau, density, packing, StressForm::printed).zz, 300 / (1500.0 * 2500));
}

TEST(DensityTowards, TakesBackAShareOfTheDifference) {
  EXPECT_EQ(density_towards(1500, 1400, 0), 0);
  EXPECT_EQ(density_towards(1500, 1500, 0.3), 0);
  EXPECT_NEAR(density_towards(1500, 1400, 1e-3), 0.1, 1e-3 * 0.1) << "of first order in the strain";
  EXPECT_LT(1400 + density_towards(1500, 1400, 1e6), 1500) << "and never past the sum";
  // A strain of 1 in small parts leaves 1/e.
  double density = 1400;
  for (int n = 0; n < 1000; ++n) density += density_towards(1500, density, 1e-3);
  EXPECT_NEAR(1500 - density, 100 * std::exp(-1.0), 0.05);
}

TEST(DensityAfter, IsTheSumToThirdOrderAndStaysPositive) {
  EXPECT_EQ(density_after(1500, 30), 1530);
  EXPECT_EQ(density_after(1500, 0), 1500);
  for (const double x : {1e-1, 1e-2, 1e-3}) {
    const double error = density_after(1500, -1500 * x) / 1500 - (1 - x);
    EXPECT_NEAR(error / (x * x * x), 1, 2 * x);
  }
  EXPECT_GT(density_after(1500, -3000), 0);
  EXPECT_LT(density_after(1500, -3000), density_after(1500, -1500));
}

TEST(Viscosity, HasMonaghansValueAndActsOnApproachOnly) {
  const double alpha = 0.1;
  const double h = 0.01, r2 = 1e-4, c = 50, rho = 1500, approach = -2e-3;
  const double mu = h * approach / (r2 + 0.01 * h * h);
  EXPECT_DOUBLE_EQ(viscosity_of(alpha, approach, r2, h, c, rho), -0.1 * c * mu / rho);
  EXPECT_GT(viscosity_of(alpha, approach, r2, h, c, rho), 0);
  EXPECT_EQ(viscosity_of(alpha, 2e-3, r2, h, c, rho), 0);
  EXPECT_EQ(viscosity_of(alpha, 0, r2, h, c, rho), 0);
}

/// Force on a particle of a cubic lattice of unit spacing and mass under a uniform uniaxial tension of 1 along z, of
/// which the layers at odd distances are shifted along z.
double force_along_z(double strength, double shift) {
  double sum = 0;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k) {
        const Vector3 d{double(i), double(j), k + (k % 2 != 0 ? shift : 0)};
        const double q = norm(d);
        if (q == 0 || q >= support) continue;
        const double tension = artificial_stress(strength, 2.0, cubic_spline_shape_of(q));
        sum += acceleration<double, double, Vector3>(1, cubic_spline_slope(q, 1.0), d, {0, 0, -2, 0, 0, 0}, tension).z;
      }
  return sum;
}

TEST(ArtificialStress, ALatticeUnderTensionStaysWithItAndPairsUpWithout) {
  // Per shift of the layers beside it, the force that draws it after them.
  const double shift = 1e-4, without = force_along_z(0, shift) / shift, with = force_along_z(1, shift) / shift;
  EXPECT_LT(without, -4);  // unstable
  EXPECT_GT(with, -0.1);
  EXPECT_GT(force_along_z(4, shift) / shift, -0.3);
}

TEST(ArtificialStress, ALatticeBearsWhatItBore) {
  double of_tension = 0, of_springs = 0;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k) {
        const double q = std::sqrt(double(i * i + j * j + k * k));
        if (q == 0 || q >= support) continue;
        const double weight = cubic_spline_slope(q, 1.0) * k * k;
        of_tension += 2 * weight, of_springs += weight * artificial_stress(1, 2.0, cubic_spline_shape_of(q));
      }
  EXPECT_NEAR(of_springs / of_tension, 0, 1e-3);
  EXPECT_EQ(artificial_stress(1, 2.0, 1.0), 0);
  EXPECT_GT(artificial_stress(1, 2.0, 1.2), 0);            // nearer: apart
  EXPECT_EQ(artificial_stress(1, 2.0, 4.0), 2.0 * 4 * 1);  // where they meet, no more than at f^2 = 2
  EXPECT_LT(artificial_stress(1, 2.0, 0.9), 0);            // farther: together
}

TEST(CoulombFriction, TakesAtMostMuTimesTheNormalImpulse) {
  EXPECT_EQ(coulomb_friction({3, 4, 0}, 2, 0.5), (Vector3{3 * 0.8, 4 * 0.8, 0}));
  EXPECT_EQ(coulomb_friction({3, 4, 0}, 20, 0.5), (Vector3{}));
  EXPECT_EQ(coulomb_friction({3, 4, 0}, -2, 0.5), (Vector3{3, 4, 0}));  // a wall that pulls does not rub
  EXPECT_EQ(coulomb_friction({}, 2, 0.5), (Vector3{}));
}

TEST(WallContact, HoldsByItsAdhesionUpToTheTipOfItsYieldLocus) {
  EXPECT_EQ(coulomb_friction({3, 4, 0}, 2, 0.5, 1), (Vector3{3 * 0.6, 4 * 0.6, 0}));
  EXPECT_EQ(coulomb_friction({3, 4, 0}, -1, 0.5, 1.5), (Vector3{3 * 0.8, 4 * 0.8, 0}));  // 1.5 - 0.5
  EXPECT_EQ(coulomb_friction({3, 4, 0}, -4, 0.5, 1.5), (Vector3{3, 4, 0}));
  EXPECT_EQ(parting(1, 1.5, 0.5), 0);
  EXPECT_EQ(parting(-2, 1.5, 0.5), 0);
  EXPECT_EQ(parting(-4, 1.5, 0.5), 1);
  EXPECT_EQ(parting(-4, 0, 0.5), 4);
  // What is not held of a pull is taken back, and no more than the rest presses or pulls.
  const WallContact wall{{0, 0, 1}, {}, -4, 0.5, 1.5, parting(-4, 1.5, 0.5)};
  EXPECT_EQ(after_contact({3, 0, -4}, wall, 0), (Vector3{3, 0, -3}));
}

TEST(PrintedFriction, DecaysAtTheSameRateWithAnyStep) {
  const Vector3 v{1, 0, 0};
  EXPECT_DOUBLE_EQ(printed_friction(v, 10, 100, 0.3, 2e-6).x, 0.95);
  EXPECT_NEAR(printed_friction(printed_friction(v, 10, 100, 0.3, 3e-6), 10, 100, 0.3, 1e-6).x, 0.95 * 0.95, 1e-15);
  EXPECT_EQ(printed_friction(v, 40, 100, 0.3, 2e-6), v);  // beyond the coefficient it slides
}

}  // namespace
}  // namespace talus::sph
