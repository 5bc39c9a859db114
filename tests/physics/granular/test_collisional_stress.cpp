// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/collisional_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/granular/appendix_b.hpp"
#include "physics/granular/equation_of_state.hpp"

namespace talus::granular {
namespace {

const Tensor3<> gradient{3, 40, -7, 10, -2, 5, 13, 1, -4};

TEST(CollisionalStress, IsEquations13And14) {
  const double time = std::sqrt(2e-4 / 9.8), tau = 500;
  const SymmetricTensor3<> stress = collisional_stress({}, time, tau, gradient);
  EXPECT_NEAR(stress.zz, 1.67 * time * 4 * tau, 1e-9);  // du_z/dz < 0 compresses: pressure
  EXPECT_NEAR(stress.xx, -1.67 * time * 3 * tau, 1e-9);
  EXPECT_NEAR(stress.xy, -0.0175 * time * 50 * tau, 1e-9);
  EXPECT_NEAR(stress.zx, -0.0175 * time * 6 * tau, 1e-9);
  EXPECT_NEAR(collisional_stress({.diagonal = 2}, time, tau, gradient).zz, 2 * stress.zz, 1e-9);
}

TEST(CollisionalStress, IsotropicReadingIsTheSameInAnyAxes) {
  const Tensor3<> rotation = rotation_about_z(0.4) * rotation_about_y(M_PI / 4);
  const double time = std::sqrt(2e-4 / 9.8);
  const CollisionParameters isotropic_reading{.form = Collisions::isotropic};
  expect_near(collisional_stress(isotropic_reading, time, 500.0, turned(gradient, rotation)),
              transformed(collisional_stress(isotropic_reading, time, 500.0, gradient), rotation), 1e-9);
  // Simple shear and uniform compression as printed.
  const CollisionParameters printed;
  EXPECT_NEAR(collisional_stress(isotropic_reading, time, 500.0, shear(30)).zx,
              collisional_stress(printed, time, 500.0, shear(30)).zx, 1e-12);
  EXPECT_NEAR(collisional_stress(isotropic_reading, time, 500.0, squeeze(30)).zz,
              collisional_stress(printed, time, 500.0, squeeze(30)).zz, 1e-12);
}

TEST(CollisionalStress, ShearTakesWork) {
  // tau : D <= 0 for shear: it resists.
  for (const Collisions form : {Collisions::printed, Collisions::isotropic})
    EXPECT_LT(double_dot(collisional_stress({.form = form}, 0.0045, 500.0, shear(30)), symmetric_part(shear(30.0))), 0);
}

TEST(CollisionalStress, CanBeLeftOut) {
  EXPECT_EQ(collisional_stress({.form = Collisions::none}, 0.0045, 500.0, shear(30)), SymmetricTensor3<>{});
}

TEST(EquationOfState, IsOneAtThePackingOfTheFits) {
  EXPECT_DOUBLE_EQ(density_factor(0.6), 1);
  EXPECT_DOUBLE_EQ(density_factor(0.3), 0.5);
}

TEST(EquationOfState, GateIsThePowerOfThePaper) {
  EXPECT_EQ(contact_gate(0.55, 0.5, 96), 1);
  EXPECT_NEAR(contact_gate(0.49, 0.5, 96), std::pow(0.98, 96), 1e-14);
  EXPECT_NEAR(contact_gate(0.49, 0.5, 300), std::pow(0.98, 300), 1e-15);
  EXPECT_NEAR(contact_gate(0.4, 0.5, 1), 0.8, 1e-15);
  EXPECT_EQ(contact_gate(0.1, 0.5, 0), 1);
}

TEST(EquationOfState, VolumetricStrainIsAThirdOfTheLogarithm) {
  EXPECT_NEAR(volumetric_strain(0.6 * std::exp(0.03), 0.6), 0.01, 1e-15);
  EXPECT_LT(volumetric_strain(0.58, 0.6), 0);
}

}  // namespace
}  // namespace talus::granular
