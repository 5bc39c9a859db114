// SPDX-License-Identifier: Apache-2.0
/// Files of triangles: how they come to stand in the box, what is mended, and what is told of those elsewhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "models/continuum/drawn_parts.hpp"
#include "models/continuum/regime.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/vessel_parts.hpp"
#include "numerics/run_record.hpp"

namespace talus::continuum {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

/// A level rectangle, in the unit of its file.
std::vector<Triangle> tray(double low, double high, double z) {
  const Vector3 a{low, low, z}, b{high, low, z}, c{high, high, z}, d{low, high, z};
  return {{{a, b, c}, 0}, {{a, c, d}, 0}};
}

VesselPart tray_of_mm(std::string name, double low, double high, double z) {
  VesselPart part = drawn(std::move(name), tray(low, high, z));
  part.unit = FileUnit::mm;
  return part;
}

/// A room of 80 mm, grains above a tray.
Parameters room_of_80() {
  Parameters p = room(8, 8, 8);
  p.bed.bottom = 4 * spacing, p.bed.height = 2 * spacing;
  p.box.floor = FaceKind::wall;
  return p;
}

/// The image of the point (1, 2, 3) mm of a file.
Vector3 image(const VesselPart& placed) {
  VesselPart part = placed;
  part.drawn = std::make_shared<DrawnSurface>(std::vector<Triangle>{{{Vector3{1, 2, 3}, {5, 2, 3}, {1, 7, 4}}, 0}});
  return placed_triangles(part).front().corner[0];
}

TEST(VesselFile, UpScaleRotateAndMoveFollowInThisOrder) {
  VesselPart part;
  part.shape = VesselShape::stl;
  const auto expect = [&](double x, double y, double z, const char* what) {
    EXPECT_LT(norm(image(part) - 1e-3 * Vector3{x, y, z}), 1e-15) << what;
  };
  expect(1, 2, 3, "as it is");
  part.up = Along::y;
  expect(1, -3, 2, "y upwards");
  part.up = Along::x;
  expect(-3, 2, 1, "x upwards");
  part.up = Along::z;
  part.rotate = {pi / 2, 0, 0};
  expect(1, -3, 2, "a quarter about x");
  part.rotate = {0, pi / 2, 0};
  expect(3, 2, -1, "about y");
  part.rotate = {0, 0, pi / 2};
  expect(-2, 1, 3, "about z");
  part.rotate = {pi / 2, 0, pi / 2};
  expect(3, 1, 2, "about x first, to (1, -3, 2), then about z");
  part.up = Along::y, part.scale = 2, part.rotate = {0, 0, pi / 2}, part.move = {0.1, 0.2, 0.3};
  expect(100 + 6, 200 + 2, 300 + 4, "up (1, -3, 2), twice (2, -6, 4), turned (6, 2, 4), moved at last");
  part = {};
  part.shape = VesselShape::stl, part.rotate = {0, 0, pi / 6};
  expect(std::cos(pi / 6) - 2 * std::sin(pi / 6), std::sin(pi / 6) + 2 * std::cos(pi / 6), 3, "30 degrees about z");
}

TEST(VesselFile, BoundsAreThoseOfThePlacedTriangles) {
  Parameters p = room_of_80();
  p.vessel = {tray_of_mm("tray", -30, 30, -10)};
  VesselPart& part = p.vessel[0];
  const auto expect_same = [&] {
    const VesselBounds around = bounds_of_vessel(p);
    const Surface surface = Boundary(p).vessel();
    EXPECT_TRUE(around.low == surface.low() && around.high == surface.high());
  };
  expect_same();
  part.move = {0.04, 0.04, 0.03};
  expect_same();
  EXPECT_NEAR(Boundary(p).vessel().low().x, 0.01, 1e-15);
  part.rotate = {0.1, 0.2, 0.3}, part.scale = 0.7, part.up = Along::x;
  expect_same();
}

TEST(VesselFile, OneThatIsElsewhereIsToldWithItsCure) {
  Parameters p = room_of_80();
  p.vessel = {tray_of_mm("tray", -30, 30, -10)};
  auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "vessel.1.file");
  EXPECT_EQ(problems[0].what,
            "tray spans -30..30 x -30..30 x -10..-10 mm, the box 0..80 x 0..80 x 0..80 mm: no part of it lies within");
  EXPECT_EQ(problems[0].allowed,
            "move = [\"40 mm\", \"40 mm\", \"10 mm\"], with which it spans 10..70 x 10..70 x 0..0 mm");
  p.vessel[0].move = {0.04, 0.04, 0.01};
  EXPECT_THAT(check(p), testing::IsEmpty());

  p.vessel[0].move = {652137.25, 5106412.75, 1800};  // as terrains are stored
  ASSERT_EQ(check(p).size(), 1u);
  EXPECT_THAT(check(p)[0].what, HasSubstr("spans 652137.22..652137.28 x 5106412.72..5106412.78 x "));
  EXPECT_THAT(check(p)[0].allowed, HasSubstr("move = [\"40 mm\", \"40 mm\", \"10 mm\"]"));
  p.vessel[0].move = {0.04, 0.04, 0.01};

  p.vessel[0].unit = FileUnit::inch;
  problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].allowed, HasSubstr("unit = \"mm\", with which it spans 10..70 x 10..70 x 0..0 mm"));
  p.vessel[0].move = {};
  EXPECT_THAT(check(p)[0].allowed, HasSubstr("unit = \"mm\" and move = [\"40 mm\", \"40 mm\", \"10 mm\"]"));
  p.box.width = p.box.depth = 0.03;
  EXPECT_THAT(check(p)[0].allowed,
              HasSubstr("unit = \"mm\", with which it spans -30..30 x -30..30 x -10..-10 mm, and a"))
      << "of two causes one is the unit";
  p.box.width = p.box.depth = 0.08;

  p.vessel = {tray_of_mm("tray", 10, 70, 30)};
  p.vessel[0].unit = FileUnit::m;
  problems = check(p);
  ASSERT_EQ(problems.size(), 1u) << "and nothing about particles without number";
  EXPECT_THAT(problems[0].what, HasSubstr("tray spans 10..70 x 10..70 x 30..30 m, the box 0..80"));
  EXPECT_EQ(problems[0].allowed, "unit = \"mm\", with which it spans 10..70 x 10..70 x 30..30 mm");

  p.vessel = {drawn("tray", tray(10e-6, 70e-6, 30e-6))};
  problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].what, HasSubstr("it is smaller than bed.spacing"));
}

TEST(VesselFile, WallsBesideTheBoxAreToldAndThoseThatStickOutAreNot) {
  Parameters p = room_of_80();
  p.vessel = {plate("lid", {-0.5, -0.5, 2}, {9, 0, 0}, {0, 9, 0})};
  EXPECT_THAT(check(p), testing::IsEmpty());
  p.vessel[0].corner[2] = 0;
  EXPECT_THAT(check(p), testing::IsEmpty()) << "on the floor";
  p.vessel[0].corner[2] = -1e-3;
  auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "vessel.1.shape");
  EXPECT_THAT(problems[0].what, HasSubstr("the box 0..80 x 0..80 x 0..80 mm: no part of it lies within"));
  p.vessel[0].corner = {0, 0, 0.02}, p.vessel[0].first_edge = {100, 0, 0};
  EXPECT_THAT(check(p)[0].what, HasSubstr("more than a thousand times as large as the box"));

  p.vessel = {plate("lid", {0, 0, 2}, {80, 0, 0}, {0, 8, 0})};
  EXPECT_NEAR(share_in_box(p, 0), 0.1, 1e-8);
  p.vessel = {plate("lid", {4, 0, 2}, {8, 0, 8}, {0, 8, 0})};
  EXPECT_NEAR(share_in_box(p, 0), 0.5, 1e-8) << "at an angle";
  p.vessel = {plate("lid", {0, 0, 2}, {100, 0, 0}, {0, 8, 0})};
  EXPECT_THAT(check(p), testing::IsEmpty());
  const auto warned = warnings_of(regime_of_case(setup_of(p)));
  EXPECT_TRUE(std::any_of(warned.begin(), warned.end(), [](const Warning& w) {
    return w.id == "share-of-lid-within-the-box" && w.text.find("lid spans 0..1000 x 0..80") != std::string::npos;
  }));
}

TEST(VesselFile, WhatIsHarmlessIsMendedWithARemark) {
  Parameters p = room_of_80();
  std::vector<Triangle> triangles = tray(10, 70, 30);
  std::swap(triangles[1].corner[0], triangles[1].corner[1]);
  triangles.push_back(triangles[0]);
  triangles.push_back({{Vector3{10, 10, 30}, {20, 10, 30}, {30, 10, 30}}, 0});
  VesselPart part = drawn("tray", triangles);
  part.unit = FileUnit::mm, part.file = "/somewhere/tray.stl";
  p.vessel = {part};
  EXPECT_THAT(check(p), testing::IsEmpty());
  EXPECT_THAT(remarks_of_vessel(p),
              testing::ElementsAre(
                  "vessel.1.file: tray.stl: 1 of 4 triangles without an area left out, triangle 4 the first",
                  "vessel.1.file: tray.stl: 1 of 4 triangles that are there twice left out, triangle 3 the first",
                  "vessel.1.file: tray.stl: 1 of 4 triangles turned over, triangle 2 the first: neighbours had their "
                  "normals on different sides"));
  const Surface surface = Boundary(p).vessel();
  ASSERT_EQ(surface.triangles().size(), 2u);
  EXPECT_EQ(norm(surface.normal(0) - surface.normal(1)), 0);
  EXPECT_EQ(surface.facets(), 1u);
  p.vessel = {tray_of_mm("tray", 10, 70, 30)};
  EXPECT_THAT(remarks_of_vessel(p), testing::IsEmpty());
}

}  // namespace
}  // namespace talus::continuum
