// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/random.hpp"
#include "shapes.hpp"

namespace talus {
namespace {

Vector3 anywhere(Random& random, double size) {
  return size * Vector3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

TEST(Surface, TheNearestPlaceOfABallIsTowardsItsMiddle) {
  const Surface surface(ball(4), 1);
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
  const Surface surface(tube(24), 1);
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
  const Surface surface(ball(3), 1);
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
  const Surface surface(tube(48), 1);
  const auto met = surface.first_crossing({-3, 0.01, 1.3}, {5, 0.01, 1.7});
  ASSERT_TRUE(met);
  EXPECT_NEAR(-3 + 8 * met->at, -1, 3e-3);
  EXPECT_FALSE(surface.first_crossing({0, 0.5, -3}, {0, 0.5, 7})) << "through the open ends";
}

TEST(Surface, AnOpenPatchIsNotThere) {
  std::vector<Triangle> triangles = square(1);
  triangles[1].patch = 1;
  Surface surface(triangles, 2);
  const Vector3 above{-0.5, 0.5, 1}, below{-0.5, 0.5, -1};
  EXPECT_TRUE(surface.blocks(above, below));
  surface.set_open(1, true);
  EXPECT_FALSE(surface.blocks(above, below));
  EXPECT_TRUE(surface.blocks({0.5, -0.5, 1}, {0.5, -0.5, -1}));
  EXPECT_NEAR(surface.nearest({-0.5, 0.5, 0}, 2)->distance, std::sqrt(0.5), 1e-12) << "the diagonal of the other half";
}

TEST(Surface, CopiesShareTheTrianglesAndHaveGatesOfTheirOwn) {
  const Surface shut(square(1), 1);
  Surface opened = shut;
  opened.set_open(0, true);
  EXPECT_EQ(opened.triangles().data(), shut.triangles().data());
  EXPECT_FALSE(opened.blocks({0.1, 0, -1}, {0.1, 0, 1}));
  EXPECT_TRUE(shut.blocks({0.1, 0, -1}, {0.1, 0, 1}));
}

TEST(Surface, EdgesBoundSmoothParts) {
  EXPECT_EQ(Surface(tube(24), 1).parts(), 1u);
  EXPECT_EQ(Surface(tube(4), 1).parts(), 4u);
  EXPECT_EQ(Surface(tube(24), 1).facets(), 24u);
  EXPECT_EQ(Surface(square(1), 1).facets(), 1u);
}

TEST(Surface, TrianglesWithoutAreaAreRefused) {
  EXPECT_THROW(Surface({{{Vector3{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0}}, 1), std::invalid_argument);
  EXPECT_THROW(Surface(square(1), 0), std::invalid_argument);
}

TEST(Surface, ItsSectionIsWhereThePlaneMeetsIt) {
  const auto lines = section_at(Surface(tube(200), 1), 0.3);
  double length = 0;
  for (const auto& [a, b] : lines) {
    EXPECT_NEAR(std::abs(a.x), std::sqrt(1 - 0.09), 1e-3);
    EXPECT_NEAR(a.y, 0.3, 1e-12);
    length += norm(b - a);
  }
  EXPECT_NEAR(length, 8, 1e-2) << "two lines, 4 high";
}

/// A ball, long slivers across it, and a speck.
std::vector<Triangle> jumble() {
  std::vector<Triangle> triangles = ball(3);
  for (int n = 0; n < 20; ++n) {
    const double angle = 0.3 * n;
    triangles.push_back(
        {{Vector3{-2, std::cos(angle), std::sin(angle)}, {3, 0.1 * n - 1, 0.2}, {3, 0.1 * n - 0.99, 0.2}}, 0});
  }
  triangles.push_back({{Vector3{0.1, 0.1, 0.1}, {0.1001, 0.1, 0.1}, {0.1, 0.1001, 0.1}}, 0});
  return triangles;
}

TEST(TriangleTree, FindsWhatAllTrianglesTell) {
  const std::vector<Triangle> all = jumble();
  const Surface surface(all, 1);
  Random random(5);
  for (int n = 0; n < 300; ++n) {
    const Vector3 a = anywhere(random, 2), b = anywhere(random, 2);
    std::optional<Surface::Crossing> first;
    Surface::Foot foot{0, {}, 1e9};
    for (std::uint32_t t = 0; t < all.size(); ++t) {
      if (const auto at = crossing(all[t], a, b); at && (!first || *at < first->at)) first = Surface::Crossing{t, *at};
      const double distance = norm(nearest_place(all[t], a) - a);
      if (distance < foot.distance) foot = {t, {}, distance};
    }
    const auto met = surface.first_crossing(a, b);
    ASSERT_EQ(met.has_value(), first.has_value());
    EXPECT_EQ(met ? met->triangle : 0, first ? first->triangle : 0);
    ASSERT_TRUE(surface.nearest(a, 5));
    EXPECT_EQ(surface.nearest(a, 5)->triangle, foot.triangle);

    std::vector<std::uint32_t> near;
    ASSERT_TRUE(surface.near(a, norm(b - a), all.size(), near));
    EXPECT_EQ(surface.blocks(a, b, near), first.has_value());
    std::vector<std::uint32_t> few;
    EXPECT_EQ(surface.near(a, norm(b - a), 3, few), near.size() <= 3);
    EXPECT_LE(few.size(), 3u);
  }
}

/// Lines that mostly pass by: what lies in a slab beside a line is left out of the search.
TEST(TriangleTree, ShortLinesAtAFineSurfaceMeetWhatAllTrianglesTell) {
  std::vector<Triangle> all = ball(4);
  for (const Triangle& t : tube(300)) all.push_back({t.corner, 1});
  const Surface surface(all, 2);
  Random random(11);
  int met = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vector3 a = anywhere(random, 1), x = (random.uniform(0.97, 1.03) / norm(a)) * a,
                  y = x + anywhere(random, 0.1);
    std::optional<Surface::Crossing> first;
    for (std::uint32_t t = 0; t < all.size(); ++t)
      if (const auto at = crossing(all[t], x, y); at && (!first || *at < first->at)) first = Surface::Crossing{t, *at};
    const auto found = surface.first_crossing(x, y);
    ASSERT_EQ(found.has_value(), first.has_value());
    if (!found) continue;
    ++met;
    EXPECT_EQ(found->triangle, first->triangle);
    EXPECT_EQ(found->at, first->at);
  }
  EXPECT_GT(met, 200);
}

/// Slabs of a vessel of two patches, one of them open: each place of a triangle that is not lies in one of them.
TEST(Surface, SlabsHoldTheTrianglesThatReachIntoABox) {
  std::vector<Triangle> all = jumble();
  for (const Triangle& t : tube(200)) all.push_back({t.corner, 1});
  for (Triangle t : square(1.2)) all.push_back({t.corner, 2});
  Surface surface(all, 3);
  surface.set_open(2, true);
  Random random(6);
  constexpr double thin = 0.02, wide = 0.4;
  for (int n = 0; n < 100; ++n) {
    const Vector3 x = anywhere(random, 1.5), half = random.uniform(0.05, 0.5) * Vector3{1, 0.7, 0.5};
    std::vector<Slab> found, few;
    ASSERT_TRUE(surface.slabs_within(x - half, x + half, thin, wide, all.size(), found));
    EXPECT_EQ(surface.slabs_within(x - half, x + half, thin, wide, 3, few), found.size() <= 3);
    EXPECT_LE(few.size(), 3u);
    for (const Slab& slab : found) {
      EXPECT_LE(slab.slack, thin);
      EXPECT_NE(slab.patch, 2u);
    }
    for (const Triangle& t : all) {
      const double u = random.uniform(), v = random.uniform() * (1 - u);
      const Vector3 place = t.corner[0] + u * (t.corner[1] - t.corner[0]) + v * (t.corner[2] - t.corner[0]),
                    d = place - x;
      if (t.patch == 2 || std::abs(d.x) > half.x || std::abs(d.y) > half.y || std::abs(d.z) > half.z) continue;
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Slab& slab) {
        return slab.patch == t.patch && slab.distance(place) <= 1e-12;
      }));
    }
  }
}

TEST(Surface, ManyTrianglesOfAFlatWallAreFewSlabs) {
  const Surface fine(ball(6), 1);  // 32,768 triangles
  std::vector<Slab> slabs;
  ASSERT_TRUE(fine.slabs_within({0.5, -0.5, -0.5}, {1.5, 0.5, 0.5}, 0.02, 1, 1000, slabs));
  EXPECT_LE(slabs.size(), 64u);
  Random random(9);
  for (int n = 0; n < 100; ++n) {
    const Vector3 x{random.uniform(0.6, 1.4), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
    double least = 10;
    for (const Slab& slab : slabs) least = std::min(least, slab.distance(x));
    const double distance = fine.nearest(x, 1)->distance;
    EXPECT_LE(least, distance);
    if (norm(x) < 1) {
      EXPECT_GE(least, distance - 2 * 0.02);  // planes cut off what is outside only
    }
  }
}

TEST(TriangleTree, PairsAreAllWhoseBoxesOverlap) {
  const std::vector<Triangle> all = jumble();
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  TriangleTree(all).for_each_near_pair([&](std::uint32_t a, std::uint32_t b) {
    EXPECT_NE(a, b);
    EXPECT_TRUE(pairs.insert(std::minmax(a, b)).second) << "each once";
  });
  const auto overlap = [&](const Triangle& s, const Triangle& t) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({s.corner[0][axis], s.corner[1][axis], s.corner[2][axis]});
      const auto [from, to] = std::minmax({t.corner[0][axis], t.corner[1][axis], t.corner[2][axis]});
      if (from > high || low > to) return false;
    }
    return true;
  };
  std::size_t expected = 0;
  for (std::uint32_t a = 0; a < all.size(); ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      if (overlap(all[a], all[b])) {
        ++expected;
        EXPECT_TRUE(pairs.contains({b, a})) << a << ' ' << b;
      }
  EXPECT_GT(expected, all.size());
  EXPECT_LT(pairs.size(), all.size() * all.size() / 4);
}

double area_of(const Surface& surface) {
  double area = 0;
  for (const Triangle& t : surface.triangles()) area += norm(t.area());
  return area;
}

TEST(SurfacePoints, HaveTheAreaOfTheSurfaceAndItsMoments) {
  for (const auto& triangles : {ball(1), ball(5), tube(7), tube(100), square(1)}) {
    const Surface surface(triangles, 1);
    const std::vector<SurfacePoint> points = spread_points(surface, 0.2);
    double area = 0;
    Vector3 moment, exact;
    for (const SurfacePoint& p : points) area += p.area, moment += p.area * p.place;
    for (const Triangle& t : surface.triangles()) exact += norm(t.area()) * t.middle();
    EXPECT_NEAR(area, area_of(surface), 1e-9 * area);
    EXPECT_NEAR(norm(moment - exact), 0, 1e-9 * area);
  }
}

TEST(SurfacePoints, AreInRowsHoweverManyTheyAre) {
  for (const int side : {100, 400}) {
    const std::vector<SurfacePoint> points = spread_points(Surface(square(1), 1), 2.0 / side);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(side * side));
    const double apart = norm(points[1].place - points[0].place);
    EXPECT_NEAR(apart, 2.0 / side, 1e-9);
    for (std::size_t n = 1; n < points.size(); ++n)
      EXPECT_NEAR(norm(points[n].place - points[n - 1].place), n % side == 0 ? std::hypot(2, apart) - 0 : apart,
                  n % side == 0 ? 0.1 : 1e-9);
  }
}

TEST(SurfacePoints, AreAsManyForAnyNumberOfTriangles) {
  const auto count = [](const std::vector<Triangle>& t) { return spread_points(Surface(t, 1), 0.2).size(); };
  const std::size_t coarse = count(ball(2)), fine = count(ball(6));  // 128 and 32768 triangles
  EXPECT_LT(fine, 1.6 * double(coarse));
  EXPECT_EQ(count(square(1)), 100u);
}

}  // namespace
}  // namespace talus
