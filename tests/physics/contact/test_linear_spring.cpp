// SPDX-License-Identifier: Apache-2.0
#include "physics/contact/linear_spring.hpp"

#include <gtest/gtest.h>

#include "physics/hydrodynamics/stokes.hpp"

namespace talus {
namespace {

TEST(LinearSpring, PushesApartWithStiffnessTimesOverlap) {
  // Centres 1.9 apart along (3, 4)/5, radii 1 and 1.1: overlap 0.2.
  const Vector3 offset{1.9 * 0.6, 1.9 * 0.8, 0};
  const Vector3 force = contact::repulsion(50, 1, 1.1, offset);
  EXPECT_NEAR(force.x, -50 * 0.2 * 0.6, 1e-13);
  EXPECT_NEAR(force.y, -50 * 0.2 * 0.8, 1e-13);
  const Vector3 reaction = contact::repulsion(50, 1.1, 1, -1.0 * offset);
  EXPECT_EQ(force + reaction, Vector3{});
}

TEST(LinearSpring, DoesNotPullAcrossAGap) {
  EXPECT_EQ(contact::repulsion(50, 1, 1, {2.0, 0, 0}), Vector3{});
  EXPECT_EQ(contact::repulsion(50, 1, 1, {2.1, 0, 0}), Vector3{});
  EXPECT_EQ(contact::linear_spring(50, contact::slope_overlap(1, 1.5)), 0);
  EXPECT_DOUBLE_EQ(contact::linear_spring(50, contact::slope_overlap(1, 0.75)), 12.5);
}

TEST(BuoyantWeight, IsEquation1) {
  // 5 mm of polystyrene in air: 4/3 pi a^3 g (20 - 1.2).
  EXPECT_NEAR(hydrodynamics::buoyant_weight(5e-3, 20, 1.2, 9.81), 9.65663e-5, 1e-10);
  EXPECT_LT(hydrodynamics::buoyant_weight(5e-3, 1, 1.2, 9.81), 0);
  const Vector3 down = hydrodynamics::downhill(0.3);
  EXPECT_DOUBLE_EQ(down.x, std::sin(0.3));
  EXPECT_DOUBLE_EQ(down.z, -std::cos(0.3));
}

}  // namespace
}  // namespace talus
