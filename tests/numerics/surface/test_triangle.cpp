// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "numerics/surface/triangle.hpp"
#include "shapes.hpp"

namespace talus {

namespace {

using Place = std::array<double, 3>;

Place place(const Vector3& x) {
  return {x.x, x.y, x.z};
}

TEST(TriangleEdges, AreThoseThatTrianglesHaveInCommon) {
  for (const auto& triangles : {ball(3), tube(17), square(2)}) {
    std::map<std::pair<Place, Place>, std::vector<std::uint32_t>> wanted;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const Place a = place(triangles[t].corner[c]), b = place(triangles[t].corner[(c + 1) % 3]);
        wanted[{std::min(a, b), std::max(a, b)}].push_back(t);
      }
    const TriangleEdges edges(triangles);
    std::size_t groups = 0;
    edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
      const Place a = place(edges.places()[same[0].from]), b = place(edges.places()[same[0].to]);
      std::vector<std::uint32_t> found;
      for (const auto& e : same) {
        found.push_back(e.triangle);
        const auto& corner = triangles[e.triangle].corner;
        const Place begin = place(corner[e.side]), end = place(corner[(e.side + 1u) % 3]);
        EXPECT_EQ(begin, e.reversed ? b : a);
        EXPECT_EQ(end, e.reversed ? a : b);
      }
      EXPECT_EQ(found, (wanted[{std::min(a, b), std::max(a, b)}]));
      ++groups;
    });
    EXPECT_EQ(groups, wanted.size());
  }
}

TEST(TriangleEdges, ACornerIsOneWhereItsNumbersAreTheSame) {
  std::vector<Triangle> triangles = ball(2);
  for (Triangle& t : triangles)
    for (Vector3& c : t.corner)
      if (c.x == 0) c.x = (&t - triangles.data()) % 2 == 0 ? 0.0 : -0.0;
  const TriangleEdges edges(triangles);
  EXPECT_EQ(edges.places().size(), 66u) << "those of the octahedron, and one for each edge that was halved";
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(edges.places()[edges.corners()[t][c]], triangles[t].corner[c]);
  EXPECT_EQ(edges.corners()[0], (std::array<std::uint32_t, 3>{0, 1, 2})) << "numbered as they come";
}

TEST(TriangleEdges, WhatIsLeftOutHasNone) {
  const std::vector<Triangle> triangles = square(1);
  std::size_t count = 0;
  TriangleEdges(triangles, {true, false}).for_each([&](std::span<const TriangleEdges::Edge> same) {
    EXPECT_EQ(same.size(), 1u);
    EXPECT_EQ(same[0].triangle, 1u);
    ++count;
  });
  EXPECT_EQ(count, 3u);
}

}  // namespace

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
