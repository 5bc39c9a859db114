// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "numerics/surface/surface.hpp"
#include "numerics/surface/surface_faults.hpp"
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

namespace {

MendedSurface mend(const std::vector<Triangle>& triangles) {
  return mended(triangles, faults_of(triangles));
}

void turn_over(Triangle& t) {
  std::swap(t.corner[1], t.corner[2]);
}

TEST(MendedSurface, OfASoundOneNothingChanges) {
  const std::vector<Triangle> sound = ball(3);
  const MendedSurface same = mend(sound);
  EXPECT_EQ(same.triangles, sound);
  EXPECT_TRUE(same.turned.empty() && same.flat.empty() && same.twice.empty());
  EXPECT_TRUE(same.branching.empty() && same.without_outside.empty());
}

TEST(MendedSurface, TheFewerTrianglesAreTurnedToTheOthers) {
  const std::vector<Triangle> sound = ball(2);
  std::vector<Triangle> mixed = sound;
  for (const std::size_t t : {3u, 4u, 50u}) turn_over(mixed[t]);
  const MendedSurface result = mend(mixed);
  EXPECT_EQ(result.turned, (std::vector<std::uint32_t>{3, 4, 50}));
  EXPECT_TRUE(faults_of(result.triangles).empty());
  for (std::size_t t = 0; t < sound.size(); ++t)
    EXPECT_NEAR(norm(result.triangles[t].normal() - sound[t].normal()), 0, 1e-12) << t;

  std::vector<Triangle> inwards = sound;
  for (Triangle& t : inwards) turn_over(t);
  turn_over(inwards[9]);
  EXPECT_EQ(mend(inwards).turned, std::vector<std::uint32_t>{9}) << "most say that they look inwards";
}

TEST(MendedSurface, WhatCountsTwiceOrNotAtAllIsLeftOut) {
  std::vector<Triangle> triangles = ball(2);
  triangles.push_back(triangles[5]);
  triangles.push_back(triangles[5]);
  turn_over(triangles.back());
  triangles.push_back({{Vector3{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0});
  triangles.push_back({{Vector3{0, 0, 0}, {1, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}}, 0});
  const std::uint32_t count = static_cast<std::uint32_t>(triangles.size());
  const MendedSurface result = mend(triangles);
  EXPECT_EQ(result.triangles, ball(2));
  EXPECT_EQ(result.twice, (std::vector<std::uint32_t>{count - 4, count - 3}));
  EXPECT_EQ(result.flat, (std::vector<std::uint32_t>{count - 2, count - 1}));
  EXPECT_TRUE(result.branching.empty()) << "edges are those of what is left";
}

TEST(MendedSurface, ABandWithATwistHasOneSide) {
  std::vector<Triangle> band;
  constexpr int pieces = 24;
  const auto at = [](int n, double side) {
    const double angle = 2 * std::numbers::pi * n / pieces, half = 0.5 * angle;
    const double out = 1 + side * std::cos(half);
    return Vector3{out * std::cos(angle), out * std::sin(angle), side * std::sin(half)};
  };
  for (int n = 0; n < pieces; ++n) {
    const bool last = n + 1 == pieces;
    const Vector3 a = at(n, -0.3), b = at(n, 0.3), c = last ? at(0, 0.3) : at(n + 1, -0.3),
                  d = last ? at(0, -0.3) : at(n + 1, 0.3);
    band.push_back({{a, c, b}, 0});
    band.push_back({{c, d, b}, 0});
  }
  const MendedSurface result = mend(band);
  EXPECT_EQ(result.triangles.size(), band.size()) << "walls need no sides";
  EXPECT_EQ(result.without_outside.size(), 1u);
}

TEST(MendedSurface, EdgesOfThreeAreTold) {
  std::vector<Triangle> triangles = square(1);
  triangles.push_back({{Vector3{-1, -1, 0}, {1, 1, 0}, {0, 0, 1}}, 0});
  const MendedSurface result = mend(triangles);
  ASSERT_EQ(result.branching.size(), 1u);
  EXPECT_EQ(norm(result.branching[0]), 0);
  const Surface surface(result.triangles, 1);
  EXPECT_EQ(surface.part(0), surface.part(1)) << "the square is one part, whatever stands on it";
  EXPECT_NE(surface.part(0), surface.part(2));
}

TEST(MendedSurface, PointsDoNotDependOnTheSidesOfNormals) {
  const std::vector<Triangle> sound = ball(3);
  std::vector<Triangle> mixed = sound;
  for (std::size_t t = 0; t < mixed.size(); t += 3) turn_over(mixed[t]);
  const auto expected = spread_points(Surface(sound, 1), 0.3), found = spread_points(Surface(mixed, 1), 0.3);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t n = 0; n < found.size(); ++n) {
    EXPECT_LT(norm(found[n].place - expected[n].place), 1e-9) << n;
    EXPECT_NEAR(std::abs(dot(found[n].normal, expected[n].normal)), 1, 1e-9) << n;
  }
}

}  // namespace

}  // namespace talus
