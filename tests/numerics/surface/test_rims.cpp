// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/rims.hpp"

#include <gtest/gtest.h>

#include "shapes.hpp"

namespace talus {
namespace {

TEST(Rims, AreClosedLinesAlongEdgesOfOneTriangle) {
  EXPECT_TRUE(rims_of(ball(2)).empty());
  const std::vector<Triangle> triangles = tube(40);
  const std::vector<Rim> rims = rims_of(triangles);
  ASSERT_EQ(rims.size(), 2u) << "below and above";
  for (const Rim& rim : rims) {
    ASSERT_EQ(rim.corners.size(), 40u);
    for (std::size_t n = 0; n < 40; ++n) {
      EXPECT_EQ(rim.corners[n].z, rim.corners[0].z);
      EXPECT_NEAR(norm(rim.corners[n] - rim.corners[(n + 1) % 40]), 2 * std::sin(std::numbers::pi / 40), 1e-12);
      const auto& corner = triangles[rim.triangles[n]].corner;
      EXPECT_NE(std::find(corner.begin(), corner.end(), rim.corners[n]), corner.end());
    }
  }
  EXPECT_NE(rims[0].corners[0].z, rims[1].corners[0].z);
}

TEST(Rims, AMissingTriangleLeavesOne) {
  std::vector<Triangle> holed = ball(2);
  const Triangle lost = holed[20];
  holed.erase(holed.begin() + 20);
  const std::vector<Rim> rims = rims_of(holed);
  ASSERT_EQ(rims.size(), 1u);
  EXPECT_EQ(rims[0].corners.size(), 3u);
  for (const Vector3& corner : lost.corner)
    EXPECT_NE(std::find(rims[0].corners.begin(), rims[0].corners.end(), corner), rims[0].corners.end());
}

}  // namespace
}  // namespace talus
