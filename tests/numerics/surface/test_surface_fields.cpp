// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
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

TEST(SurfaceFields, TheAreaOfAFieldIsWhereItsLoadsComeFrom) {
  // Loads spread evenly over a wall are the same pressure on all of its fields, whatever their shapes.
  const Surface surface(tube_with_floor(), 2);
  const SurfaceFields fields(surface, 0.4);
  std::vector<double> load(fields.count());
  constexpr int around = 2400, along = 500;
  const double own = area_of(tube(24)) / (around * along);
  for (int m = 0; m < around; ++m)
    for (int n = 0; n < along; ++n) {
      const double facet = std::floor(m / 100.0), share = (m % 100 + 0.5) / 100;  // of 24
      const auto corner = [](double at) {
        const double angle = 2 * std::numbers::pi * at / 24;
        return Vector3{std::cos(angle), std::sin(angle), 0};
      };
      Vector3 place = (1 - share) * corner(facet) + share * corner(facet + 1);
      place.z = surface.low().z + (surface.high().z - surface.low().z) * (n + 0.5) / along;
      load[fields.at(surface.part(0), place)] += own;
    }
  for (std::size_t n = 0; n < fields.count(); ++n)
    if (fields.all()[n].part == surface.part(0)) {
      EXPECT_NEAR(load[n] / fields.all()[n].area, 1, 0.2) << n;
    }
}

TEST(SurfaceFields, AFootprintIsSharedWhereAnotherFieldBegins) {
  const Surface surface(tube_with_floor(), 2);
  const SurfaceFields fields(surface, 0.4);
  const std::uint32_t wall = surface.part(0);
  for (int n = 0; n < 200; ++n) {
    const Vector3 place{std::cos(0.7 * n), std::sin(0.7 * n), surface.low().z + 0.2 + 0.005 * n};
    const FieldShare found = fields.under(wall, place);
    int first = 0;
    constexpr int tries = 1000;  // along the footprint, 0.2 high
    for (int k = 0; k < tries; ++k)
      first += fields.at(wall, place + Vector3{0, 0, 0.2 * ((k + 0.5) / tries - 0.5)}) == found.field ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(first) / tries, found.share, 0.01) << n;
  }
  const std::uint32_t floor = surface.part(surface.triangles().size() - 1);
  EXPECT_EQ(fields.under(floor, {0.21, 0.1, 0}).share, 1) << "a level part has no line of steepest descent";
}

TEST(SurfaceFields, OnlyAreaWithinTheBoxCounts) {
  const Surface surface(tube_with_floor(), 2);
  const SurfaceFields half(surface, 0.1, {}, {0, -9, -9}, {9, 9, 9});
  double area = 0;
  for (const SurfacePoint& field : half.all()) area += field.area;
  EXPECT_NEAR(area, 0.5 * area_of(tube_with_floor()), 0.01 * area);
  double drawn = 0;
  const FieldMesh mesh = mesh_of(surface, half, 0.15);
  for (const auto& [a, b, c] : mesh.corners) {
    const auto corner = [&](std::int64_t n) { return mesh.points[static_cast<std::size_t>(n)]; };
    drawn += norm(Triangle{{corner(a), corner(b), corner(c)}, 0}.area());
  }
  EXPECT_NEAR(drawn, area, 0.02 * area);
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

TEST(SurfaceFields, TrianglesOfAFlatWallHaveTheAreasOfItsFields) {
  const Surface plate({{{Vector3{0, 0, 0}, {3, 0, 0}, {3, 2, 0}}, 0}, {{Vector3{0, 0, 0}, {3, 2, 0}, {0, 2, 0}}, 0}},
                      1);
  const SurfaceFields fields(plate, 0.4);
  const FieldMesh mesh = mesh_of(plate, fields, 0.6);
  std::vector<double> area(fields.count(), 0.0);
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    const auto corner = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(mesh.corners[t][c])]; };
    area[mesh.field[t]] += norm(Triangle{{corner(0), corner(1), corner(2)}, 0}.area());
  }
  for (std::size_t n = 0; n < area.size(); ++n)
    EXPECT_NEAR(area[n] / fields.all()[n].area, 1, 0.2) << "cut by their edges alone: 0.4";
}

}  // namespace
}  // namespace talus
