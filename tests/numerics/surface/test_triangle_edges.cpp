// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/triangle_edges.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

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
}  // namespace talus
