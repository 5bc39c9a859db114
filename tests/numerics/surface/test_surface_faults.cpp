// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_faults.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "shapes.hpp"

namespace talus {
namespace {

using Kind = SurfaceFault::Kind;

TEST(SurfaceFaults, AGoodSurfaceHasNone) {
  EXPECT_TRUE(faults_of(ball(3)).empty());
  EXPECT_TRUE(faults_of(tube(40)).empty()) << "rims are no fault";
}

TEST(SurfaceFaults, NameTheTriangleAndThePlace) {
  std::vector<Triangle> triangles = ball(2);
  std::swap(triangles[17].corner[0], triangles[17].corner[1]);
  const auto turned = faults_of(triangles);
  ASSERT_EQ(turned.size(), 3u) << "with each of its neighbours";
  for (const SurfaceFault& fault : turned) {
    EXPECT_EQ(fault.kind, Kind::turned_over);
    EXPECT_TRUE(fault.triangle == 17 || fault.other == 17);
    EXPECT_LT(norm(fault.place - triangles[17].middle()), 0.5);
  }

  triangles = ball(2);
  triangles.push_back(triangles[5]);
  const auto twice = faults_of(triangles);
  ASSERT_FALSE(twice.empty());
  EXPECT_EQ(twice.front().kind, Kind::twice);
  EXPECT_EQ(twice.front().triangle, 5u);
  EXPECT_EQ(twice.front().other, triangles.size() - 1);

  triangles = ball(2);
  triangles[9].corner[2] = triangles[9].corner[1];
  triangles[11].corner[0].y = std::numeric_limits<double>::quiet_NaN();
  const auto flat = faults_of(triangles);
  ASSERT_EQ(flat.size(), 2u);
  EXPECT_EQ(flat[0].kind, Kind::without_area);
  EXPECT_EQ(flat[0].triangle, 9u);
  EXPECT_EQ(flat[1].kind, Kind::not_finite);
  EXPECT_EQ(flat[1].triangle, 11u);
}

TEST(SurfaceFaults, ASurfaceThatPassesThroughItselfIsFound) {
  std::vector<Triangle> triangles = square(1);
  triangles.push_back({{Vector3{0.2, -0.1, -1}, {0.4, -0.1, -1}, {0.3, -0.1, 1}}, 0});
  const auto faults = faults_of(triangles);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().kind, Kind::crossing_another);
  EXPECT_EQ(faults.front().triangle, 0u);
  EXPECT_EQ(faults.front().other, 2u);
  EXPECT_NEAR(faults.front().place.z, 0, 1e-12);
  EXPECT_NEAR(faults.front().place.y, -0.1, 1e-12);
  triangles.back() = {{Vector3{0.2, -0.1, 0}, {0.4, -0.1, 0}, {0.3, -0.1, 1}}, 0};
  EXPECT_TRUE(faults_of(triangles).empty()) << "it stands on the square";
}

TEST(SurfaceFaults, RimsCountWhereASurfaceIsToBeClosed) {
  EXPECT_TRUE(faults_of(ball(2), true).empty());
  EXPECT_EQ(faults_of(tube(12), true).size(), 24u) << "below and above";
  std::vector<Triangle> holed = ball(2);
  const Triangle lost = holed[20];
  holed.erase(holed.begin() + 20);
  const auto faults = faults_of(holed, true);
  ASSERT_EQ(faults.size(), 3u);
  for (const SurfaceFault& fault : faults) {
    EXPECT_EQ(fault.kind, Kind::open_rim);
    EXPECT_FALSE(fault.other);
    EXPECT_LT(norm(fault.place - lost.middle()), 0.4);
    EXPECT_LT(norm(fault.place - holed[fault.triangle].middle()), 0.4) << "the number is that of a neighbour";
  }
}

TEST(SurfaceFaults, AThirdTriangleAtAnEdgeIsFound) {
  std::vector<Triangle> triangles = square(1);
  triangles.push_back({{Vector3{-1, -1, 0}, {1, 1, 0}, {0, 0, 1}}, 0});
  const auto faults = faults_of(triangles);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().kind, Kind::branching);
}

}  // namespace
}  // namespace talus
