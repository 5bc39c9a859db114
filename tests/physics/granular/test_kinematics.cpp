// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/granular/appendix_b.hpp"

namespace talus::granular {
namespace {

const Tensor3<> unit = full(isotropic(1.0));

TEST(AlmansiStrain, IsPositiveInCompression) {
  // Squashed to 0.8 along z: (1/0.64 - 1)/2.
  expect_near(almansi_strain(Tensor3<>{.zz = -0.2}), {.zz = 0.28125}, 1e-15);
  // Small strains: minus the symmetric gradient, and no digits lost.
  expect_near(almansi_strain(Tensor3<>{.xx = 1e-9, .xy = 3e-9, .yx = 1e-9, .zz = -2e-9}),
              {.xx = -1e-9, .zz = 2e-9, .xy = -2e-9}, 2e-17);
}

TEST(AlmansiStrain, OfASimpleShear) {
  // x = X + s Z: B^-1 = F^-T F^-1 has zx = -s and zz = 1 + s^2.
  expect_near(almansi_strain(Tensor3<>{.xz = 0.3}), {.zz = 0.045, .zx = -0.15}, 1e-15);
}

TEST(AlmansiStrain, DoesNotSeeARotationAndTurnsWithTheBody) {
  const Tensor3<> turn = rotation_about_y(0.7);
  expect_near(almansi_strain(turn - unit), {}, 1e-15);
  const Tensor3<> gradient{0.1, 0.02, -0.03, 0.01, -0.2, 0.05, 0.2, 0.04, 0.3};
  // F' = R F.
  const Tensor3<> turned = turn * (unit + gradient) - unit;
  expect_near(almansi_strain(turned), transformed(almansi_strain(gradient), turn), 1e-15);
}

TEST(TransportedStrain, ReachesTheStrainOfTheWholeDeformation) {
  // A constant velocity gradient deforms by F = exp(L t), here by its series.
  const Tensor3<> velocity_gradient{0.2, 0.5, -0.3, 0.1, -0.6, 0.4, 0.7, -0.2, 0.1};
  Tensor3<> deformation = unit, term = unit;
  for (int k = 1; k < 20; ++k) {
    term = (1.0 / k) * (term * velocity_gradient);
    deformation = deformation + term;
  }
  const SymmetricTensor3<> exact = almansi_strain(deformation - unit);
  double errors[2];
  for (int refinement = 0; refinement < 2; ++refinement) {
    const int steps = 100 << refinement;
    SymmetricTensor3<> strain;
    for (int n = 0; n < steps; ++n) strain = transported_strain(strain, velocity_gradient, 1.0 / steps);
    errors[refinement] = norm(strain - exact);
  }
  EXPECT_LT(errors[1], 1e-4);
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.1);  // second order
}

TEST(TransportedStrain, TurnsWithARigidRotation) {
  const SymmetricTensor3<> start{1e-3, -2e-3, 4e-3, 5e-4, -1e-3, 2e-3};
  SymmetricTensor3<> strain = start;
  const int steps = 2000;
  const Tensor3<> spin{.xz = 2 * M_PI, .zx = -2 * M_PI};
  for (int n = 0; n < steps / 4; ++n) strain = transported_strain(strain, spin, 1.0 / steps);
  // The angle t a step is too large by 2 t^3/3, of a difference xx - zz of 3e-3 and a zx of 2e-3.
  const double late = 500 * 2 * std::pow(2 * M_PI / steps, 3) / 3;
  expect_near(strain, transformed(start, rotation_about_y(M_PI / 2)), 2.01 * late * 2e-3);
  EXPECT_NEAR(norm(strain) / norm(start), 1, 500 * 2 * std::pow(2 * M_PI / steps, 4));
  // Without strain it stays so, however coarse the steps.
  EXPECT_EQ(transported_strain({}, spin, 0.1), SymmetricTensor3<>{});
}

TEST(RotationOfStep, IsARotation) {
  const Tensor3<> gradient{0.2, 0.5, -0.3, 0.1, -0.6, 0.4, 0.7, -0.2, 0.1};
  const Tensor3<> turn = rotation_of_step(gradient, 0.5);
  const Tensor3<> difference = turn * transpose(turn) - unit;
  EXPECT_NEAR(norm(symmetric_part(difference)), 0, 1e-15);
  // About y by the angle 2 atan(t/2), t = 0.4.
  const Tensor3<> about_y = rotation_of_step(Tensor3<>{.xz = 1, .zx = -1}, 0.4);
  EXPECT_NEAR(about_y.xz, std::sin(2 * std::atan(0.2)), 1e-15);
  // Every axis with its sign: (I - A) R = I + A.
  const Tensor3<> half = 0.25 * antisymmetric_part(gradient);
  const Tensor3<> left = (unit - half) * turn - (unit + half);
  for (const double component : {left.xx, left.xy, left.xz, left.yx, left.yy, left.yz, left.zx, left.zy, left.zz})
    EXPECT_NEAR(component, 0, 1e-15);
}

}  // namespace
}  // namespace talus::granular
