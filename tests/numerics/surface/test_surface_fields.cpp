// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "numerics/surface/shapes.hpp"

namespace talus {
namespace {

double area_of(const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const Triangle& t : triangles) area += norm(t.area());
  return area;
}

std::vector<Triangle> tube_with_floor() {
  std::vector<Triangle> all = tube(24);
  for (Triangle t : square(1)) t.patch = 1, all.push_back(t);
  return all;
}

TEST(SurfaceFields, CoverTheSurface) {
  const Surface surface(tube_with_floor(), 2);
  const SurfaceFields fields(surface, 0.4);
  double area = 0;
  for (const SurfacePoint& field : fields.all()) area += field.area;
  EXPECT_NEAR(area, area_of(tube_with_floor()), 1e-12);
  EXPECT_GT(fields.count(), area / (0.4 * 0.4) * 0.9);
}

TEST(SurfaceFields, APlaceBelongsToTheNearestOfItsPart) {
  const Surface surface(tube_with_floor(), 2);
  const SurfaceFields fields(surface, 0.4);
  for (int n = 0; n < 200; ++n) {
    const Vector3 place{std::cos(0.7 * n), std::sin(0.7 * n), 0.02 * n};
    const std::uint32_t part = surface.part(0), found = fields.at(part, place);
    double least = 1e9;
    for (const SurfacePoint& field : fields.all())
      if (field.part == part) least = std::min(least, norm(field.place - place));
    EXPECT_EQ(fields.all()[found].part, part);
    EXPECT_EQ(norm(fields.all()[found].place - place), least) << n;
  }
  const std::uint32_t far = fields.at(surface.part(0), {0, 9, 9});
  EXPECT_EQ(fields.all()[far].part, surface.part(0)) << "also of a place beyond the reach of its grid";
}

TEST(SurfaceFields, TheMeshIsTheSurfaceCutFine) {
  const Surface surface(tube_with_floor(), 2);
  const SurfaceFields fields(surface, 0.4);
  const FieldMesh mesh = mesh_of(surface, fields, 0.5);
  ASSERT_EQ(mesh.field.size(), mesh.corners.size());
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) triangle.corner[c] = mesh.points[static_cast<std::size_t>(mesh.corners[t][c])];
    for (std::size_t c = 0; c < 3; ++c) EXPECT_LE(norm(triangle.corner[(c + 1) % 3] - triangle.corner[c]), 0.5);
    const std::optional<Surface::Foot> foot = surface.nearest(triangle.middle(), 1e-9);
    ASSERT_TRUE(foot) << "it lies on the surface";
    EXPECT_EQ(fields.all()[mesh.field[t]].patch, surface.triangles()[foot->triangle].patch);
  }
  EXPECT_NEAR(area_of(triangles), area_of(tube_with_floor()), 1e-10);
  std::set<std::array<double, 3>> distinct;
  for (const Vector3& x : mesh.points) distinct.insert({x.x, x.y, x.z});
  EXPECT_EQ(distinct.size(), mesh.points.size()) << "each corner once";
}

}  // namespace
}  // namespace talus
