// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/friction_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/unit.hpp"
#include "physics/granular/appendix_b.hpp"
#include "physics/granular/material_path.hpp"

namespace talus::granular {
namespace {

/// Grains without peak, strength at rest and rate, pressed together, then deformed at constant volume until they yield.
std::vector<SymmetricTensor3<>> yielding(double friction, const Tensor3<>& gradient) {
  std::vector<SymmetricTensor3<>> stresses;
  for (const AnyLaw& law :
       {make_law(
            CriticalState::Parameters{
                .static_friction = friction, .dynamic_friction = friction, .dilatancy = 0, .ageing_strength = 0},
            2500),
        make_law(DruckerPrager::Parameters{.friction = friction}, 2500)}) {
    const std::vector<PathStretch> path = {{1, squeeze(1e-3)}, {1, gradient}};
    stresses.push_back(follow_path(law, path, {.max_increment = 1e-5, .points = 1}).back().stress);
  }
  return stresses;
}

TEST(FrictionAngle, IsThatOfTheLawOnThePlaneOfShear) {
  for (const double friction : {0.38, 0.577, 0.9})
    for (const SymmetricTensor3<>& stress : yielding(friction, shear(0.1))) {
      ASSERT_GT(stress.zz, 1000);
      EXPECT_NEAR(std::atan(-stress.zx / stress.zz), angle_of_friction(FrictionTest::shear_plane, friction), 1e-3);
    }
}

TEST(FrictionAngle, IsThatOfMohrsCircleOfTheLawInPlaneStrain) {
  for (const double friction : {0.38, 0.577, 0.9}) {
    for (const SymmetricTensor3<>& stress : yielding(friction, {.xx = 0.02, .zz = -0.02}))
      EXPECT_NEAR(std::asin((stress.zz - stress.xx) / (stress.zz + stress.xx)),
                  angle_of_friction(FrictionTest::plane_strain, friction), 1e-4);
    // The same circle in simple shear.
    for (const SymmetricTensor3<>& stress : yielding(friction, shear(0.1))) {
      const double radius = std::hypot(0.5 * (stress.xx - stress.zz), stress.zx);
      EXPECT_NEAR(radius / (0.5 * (stress.xx + stress.zz)), friction, 1e-4);
    }
  }
}

TEST(FrictionAngle, IsThatOfTheLawInTriaxialCompression) {
  for (const double friction : {0.38, 0.577, 0.9})
    for (const SymmetricTensor3<>& stress : yielding(friction, {.xx = 0.01, .yy = 0.01, .zz = -0.02})) {
      EXPECT_NEAR(stress.xx, stress.yy, 1e-6 * stress.zz);
      EXPECT_NEAR(std::asin((stress.zz - stress.xx) / (stress.zz + stress.xx)),
                  angle_of_friction(FrictionTest::triaxial_compression, friction), 1e-4);
    }
}

TEST(FrictionAngle, ThirtyDegreesOfATesterAre35InPlaneStrainAnd25InCompression) {
  const double friction = std::tan(30 * degree);
  EXPECT_NEAR(angle_of_friction(FrictionTest::shear_plane, friction) / degree, 30, 1e-9);
  EXPECT_NEAR(angle_of_friction(FrictionTest::plane_strain, friction) / degree, 35.26, 0.01);
  EXPECT_NEAR(angle_of_friction(FrictionTest::triaxial_compression, friction) / degree, 25.38, 0.01);
  EXPECT_TRUE(std::isnan(angle_of_friction(FrictionTest::plane_strain, 1.01)));
  EXPECT_NEAR(angle_of_friction(FrictionTest::triaxial_compression, std::numbers::sqrt3) / degree, 90, 1e-5);
}

}  // namespace
}  // namespace talus::granular
