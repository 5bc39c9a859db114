// SPDX-License-Identifier: Apache-2.0
#include "numerics/sph/velocity_gradient.hpp"

#include <gtest/gtest.h>

namespace talus::sph {
namespace {

TEST(VelocityGradient, IsExactForALinearFieldWhateverTheNeighbours) {
  const Tensor3<> exact{1, -2, 0.5, 3, -1, 0.25, 0.75, 2, -0.5};
  GradientSums<> sums;
  for (const Vector3 d : {Vector3{1, 0.1, 0}, {0.2, -1, 0.3}, {0, 0.3, 1}, {-0.7, 0.2, 0.1}, {0.5, 0.5, -0.5}}) {
    const Vector3 du{exact.xx * d.x + exact.xy * d.y + exact.xz * d.z, exact.yx * d.x + exact.yy * d.y + exact.yz * d.z,
                     exact.zx * d.x + exact.zy * d.y + exact.zz * d.z};
    sums.add(0.3, -1.1 - d.x, d, du);
  }
  const Tensor3<> found = velocity_gradient(sums);
  EXPECT_NEAR(found.xx, exact.xx, 1e-13);
  EXPECT_NEAR(found.xy, exact.xy, 1e-13);
  EXPECT_NEAR(found.xz, exact.xz, 1e-13);
  EXPECT_NEAR(found.yx, exact.yx, 1e-13);
  EXPECT_NEAR(found.yz, exact.yz, 1e-13);
  EXPECT_NEAR(found.zx, exact.zx, 1e-13);
  EXPECT_NEAR(found.zy, exact.zy, 1e-13);
  EXPECT_NEAR(found.zz, exact.zz, 1e-13);
}

TEST(VelocityGradient, StaysFiniteForALoneParticleAndForALineOfThem) {
  EXPECT_EQ(velocity_gradient(GradientSums<>{}), Tensor3<>{});
  GradientSums<> line;
  line.add(0.5, -1, {1, 0, 0}, {0, 2, 0});
  EXPECT_EQ(velocity_gradient(line).yx, 1.0);
}

}  // namespace
}  // namespace talus::sph
