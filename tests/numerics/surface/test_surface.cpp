// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "numerics/surface/section.hpp"
#include "numerics/surface/surface_points.hpp"
#include "shapes.hpp"

namespace talus {
namespace {

Vector3 anywhere(Random& random, double size) {
  return size * Vector3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

TEST(Surface, TheNearestPlaceOfABallIsTowardsItsMiddle) {
  const Surface surface(ball(4), 1, 0.1);
  Random random(1);
  for (int n = 0; n < 300; ++n) {
    const Vector3 x = anywhere(random, 1.2);
    const auto foot = surface.nearest(x, 1.0);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, std::abs(norm(x) - 1), 5e-3);  // the triangles are within the sphere
    EXPECT_NEAR(norm(foot->place - x), foot->distance, 1e-12);
    EXPECT_FALSE(surface.nearest(x, 0.9 * foot->distance));
  }
}

TEST(Surface, TheNearestPlaceIsThatOfAllTriangles) {
  const Surface surface(tube(24), 1, 0.2);
  Random random(2);
  for (int n = 0; n < 300; ++n) {
    const Vector3 x = anywhere(random, 1.5) + Vector3{0, 0, 2};
    double least = 1e9;
    for (const Triangle& t : surface.triangles()) least = std::min(least, norm(nearest_place(t, x) - x));
    const auto foot = surface.nearest(x, 3.0);
    ASSERT_TRUE(foot);
    EXPECT_EQ(foot->distance, least);
  }
}

TEST(Surface, NoLineSlipsThroughBetweenTriangles) {
  // Also lines through edges and corners: out of a closed ball every line crosses once, from both ends.
  const Surface surface(ball(3), 1, 0.15);
  Random random(3);
  int found = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vector3 a = anywhere(random, 0.3);
    Vector3 b = anywhere(random, 1);
    b = (2 / norm(b)) * b;
    if (n % 4 == 0) b = a + 2.5 * (surface.triangles()[std::size_t(n) % surface.triangles().size()].corner[0] - a);
    if (n % 4 == 1) {
      const Triangle& t = surface.triangles()[std::size_t(n) % surface.triangles().size()];
      b = a + 2.5 * (0.5 * (t.corner[1] + t.corner[2]) - a);
    }
    EXPECT_TRUE(surface.first_crossing(a, b));
    EXPECT_EQ(surface.blocks(a, b), surface.blocks(b, a));
    const auto met = surface.first_crossing(a, b);
    found += met && norm(a + met->at * (b - a)) < 1 + 1e-12 && norm(a + met->at * (b - a)) > 0.95;
    EXPECT_FALSE(surface.blocks(a, 0.9 * a));
  }
  EXPECT_EQ(found, 2000);
}

TEST(Surface, TheFirstOfSeveralCrossingsIsFound) {
  const Surface surface(tube(48), 1, 0.1);
  const auto met = surface.first_crossing({-3, 0.01, 1.3}, {5, 0.01, 1.7});
  ASSERT_TRUE(met);
  EXPECT_NEAR(-3 + 8 * met->at, -1, 3e-3);
  EXPECT_FALSE(surface.first_crossing({0, 0.5, -3}, {0, 0.5, 7})) << "through the open ends";
}

TEST(Surface, AnOpenPatchIsNotThere) {
  std::vector<Triangle> triangles = square(1);
  triangles[1].patch = 1;
  Surface surface(triangles, 2, 0.3);
  const Vector3 above{-0.5, 0.5, 1}, below{-0.5, 0.5, -1};
  EXPECT_TRUE(surface.blocks(above, below));
  surface.open(1);
  EXPECT_FALSE(surface.blocks(above, below));
  EXPECT_TRUE(surface.blocks({0.5, -0.5, 1}, {0.5, -0.5, -1}));
  EXPECT_NEAR(surface.nearest({-0.5, 0.5, 0}, 2)->distance, std::sqrt(0.5), 1e-12) << "the diagonal of the other half";
}

TEST(Surface, EdgesBoundSmoothParts) {
  EXPECT_EQ(Surface(tube(24), 1, 1).parts(), 1u);
  EXPECT_EQ(Surface(tube(4), 1, 1).parts(), 4u);
  EXPECT_EQ(Surface(tube(24), 1, 1).facets(), 24u);
  EXPECT_EQ(Surface(square(1), 1, 1).facets(), 1u);
}

TEST(Surface, TrianglesWithoutAreaAreRefused) {
  EXPECT_THROW(Surface({{{Vector3{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0}}, 1, 1), std::invalid_argument);
  EXPECT_THROW(Surface(square(1), 0, 1), std::invalid_argument);
}

TEST(Surface, ItsSectionIsWhereThePlaneMeetsIt) {
  const auto lines = section_at(Surface(tube(200), 1, 1), 0.3);
  double length = 0;
  for (const auto& [a, b] : lines) {
    EXPECT_NEAR(std::abs(a.x), std::sqrt(1 - 0.09), 1e-3);
    EXPECT_NEAR(a.y, 0.3, 1e-12);
    length += norm(b - a);
  }
  EXPECT_NEAR(length, 8, 1e-2) << "two lines, 4 high";
}

double area_of(const Surface& surface) {
  double area = 0;
  for (const Triangle& t : surface.triangles()) area += norm(t.area());
  return area;
}

TEST(SurfacePoints, HaveTheAreaOfTheSurfaceAndItsMoments) {
  for (const auto& triangles : {ball(1), ball(5), tube(7), tube(100), square(1)}) {
    const Surface surface(triangles, 1, 0.2);
    const std::vector<SurfacePoint> points = spread_points(surface, 0.2);
    double area = 0;
    Vector3 moment, exact;
    for (const SurfacePoint& p : points) area += p.area, moment += p.area * p.place;
    for (const Triangle& t : surface.triangles()) exact += norm(t.area()) * t.middle();
    EXPECT_NEAR(area, area_of(surface), 1e-9 * area);
    EXPECT_NEAR(norm(moment - exact), 0, 1e-9 * area);
  }
}

TEST(SurfacePoints, AreAsManyForAnyNumberOfTriangles) {
  const auto count = [](const std::vector<Triangle>& t) { return spread_points(Surface(t, 1, 0.2), 0.2).size(); };
  const std::size_t coarse = count(ball(2)), fine = count(ball(6));  // 128 and 32768 triangles
  EXPECT_LT(fine, 1.6 * double(coarse));
  EXPECT_EQ(count(square(1)), 100u);
}

}  // namespace
}  // namespace talus
