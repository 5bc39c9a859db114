// SPDX-License-Identifier: Apache-2.0
/// The law that docs/how-to/my-law.md shows is one.
#include <gtest/gtest.h>

#include <cmath>

#include "../../../docs/how-to/cohesive_grains.hpp"

namespace talus::granular {
namespace {

using Point = MaterialPoint<CohesiveGrains>;

/// The stress after `steps` steps of 1 ms with a constant velocity gradient.
Point follow(const CohesiveGrains& law, Point point, const Tensor3<>& gradient, int steps) {
  for (int n = 0; n < steps; ++n) point = law.update(point, gradient, 1500.0, 1e-3);
  return point;
}

Tensor3<> squeeze(double rate) {
  Tensor3<> gradient{};
  gradient.xx = gradient.yy = gradient.zz = -rate;
  return gradient;
}
Tensor3<> shear(double rate) {
  Tensor3<> gradient{};
  gradient.xz = rate;
  return gradient;
}

TEST(CohesiveGrains, HoldCohesionAndFrictionInShear) {
  const CohesiveGrains law({.friction = 0.5, .cohesion = 100});
  const Point squeezed = follow(law, {}, squeeze(1e-3), 100);  // by 1e-4 along each axis
  EXPECT_NEAR(trace(squeezed.stress) / 3, 4.9e6 * 3e-4, 1e-6);
  const Point sheared = follow(law, squeezed, shear(1e-2), 200);
  EXPECT_NEAR(trace(sheared.stress) / 3, 4.9e6 * 3e-4, 1e-6);
  EXPECT_NEAR(norm(deviator(sheared.stress)) / std::sqrt(2.0), 100 + 0.5 * 4.9e6 * 3e-4, 1e-6);
  EXPECT_NEAR(std::abs(sheared.stress.zx), 100 + 0.5 * 4.9e6 * 3e-4, 0.01);
}

TEST(CohesiveGrains, HoldCohesionWithoutPressureAndBearNoTension) {
  const CohesiveGrains law({.cohesion = 100});
  const Point sheared = follow(law, {}, shear(1e-2), 200);
  EXPECT_NEAR(std::abs(sheared.stress.zx), 100, 0.01);
  EXPECT_EQ(trace(follow(law, {}, squeeze(-1e-3), 10).stress), 0);
}

}  // namespace
}  // namespace talus::granular
