// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/walls_beyond_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::continuum {
namespace {

constexpr double reach = 0.25;

Box box_with(FaceKind low, FaceKind high) {
  return {.low = {0, 0, 0},
          .high = {1, 1, 1},
          .faces = {low, high, FaceKind::open, FaceKind::open, FaceKind::open, FaceKind::open}};
}

/// A level rectangle at half the height, along y from 0 to 1.
std::vector<Triangle> sheet(double from, double to, std::uint32_t patch = 0) {
  const Vector3 a{from, 0, 0.5}, b{to, 0, 0.5}, c{to, 1, 0.5}, d{from, 1, 0.5};
  return {{{a, b, c}, patch}, {{a, c, d}, patch}};
}

struct Seen {
  double low = 1e9, high = -1e9, area = 0;
};
Seen seen(const std::vector<Triangle>& triangles) {
  Seen all;
  for (const Triangle& t : triangles) {
    all.area += t.area().z;  // of a copy whose normal is turned over less than nothing
    for (const Vector3& x : t.corner) all.low = std::min(all.low, x.x), all.high = std::max(all.high, x.x);
  }
  return all;
}

void expect_extent(const std::vector<Triangle>& triangles, double low, double high) {
  const Seen all = seen(triangles);
  EXPECT_NEAR(all.low, low, 1e-12);
  EXPECT_NEAR(all.high, high, 1e-12);
  EXPECT_NEAR(all.area, high - low, 1e-12) << "each place once, with the normal upwards";
}

TEST(WallsBeyondFaces, AMirrorHasImagesOfAWallThatEndsAtIt) {
  for (const FaceKind kind : {FaceKind::symmetry, FaceKind::wall}) {
    expect_extent(with_walls_beyond_faces(sheet(0, 1), box_with(kind, FaceKind::open), reach), -reach, 1);
    expect_extent(with_walls_beyond_faces(sheet(0, 1), box_with(kind, kind), reach), -reach, 1 + reach);
    expect_extent(with_walls_beyond_faces(sheet(0, 0.1), box_with(kind, kind), reach), -0.1, 0.1);
  }
}

TEST(WallsBeyondFaces, APeriodicFaceHasCopiesOfWhatLiesAtTheOther) {
  const Box ring = box_with(FaceKind::periodic, FaceKind::periodic);
  expect_extent(with_walls_beyond_faces(sheet(0, 1), ring, reach), -reach, 1 + reach);
  const std::vector<Triangle> half = with_walls_beyond_faces(sheet(0.9, 1), ring, reach);
  EXPECT_NEAR(seen(half).area, 0.2, 1e-12) << "behind the low face what lies at the high one";
  EXPECT_NEAR(seen(half).low, -0.1, 1e-12);
}

TEST(WallsBeyondFaces, WallsThatGoOnAreCutAndThoseThatKeepAwayStayAsTheyAre) {
  for (const FaceKind kind : {FaceKind::wall, FaceKind::symmetry, FaceKind::periodic}) {
    for (const double beyond : {0.01, 0.5}) {
      const double far = kind == FaceKind::periodic ? std::max(beyond, reach) : reach;
      expect_extent(with_walls_beyond_faces(sheet(-beyond, 1 + beyond), box_with(kind, kind), reach), -far, 1 + far);
    }
    EXPECT_EQ(with_walls_beyond_faces(sheet(0.1, 0.9), box_with(kind, kind), reach), sheet(0.1, 0.9));
  }
  for (const auto& [from, to] : {std::pair{-0.5, 1.5}, {0.0, 1.0}})
    EXPECT_EQ(with_walls_beyond_faces(sheet(from, to), box_with(FaceKind::open, FaceKind::open), reach),
              sheet(from, to));
}

TEST(WallsBeyondFaces, APlateAboutAnAxisIsThereOnceAndWithoutGaps) {
  Box box = box_with(FaceKind::symmetry, FaceKind::open);
  box.faces[2] = FaceKind::symmetry;
  const Vector3 middle{0, 0, 0.5};
  std::vector<Triangle> fan;  // its corners miss the planes by rounding
  const auto corner = [&](int n) {
    const double angle = 2 * std::numbers::pi * n / 36;
    return middle + Vector3{std::cos(angle), std::sin(angle), 0};
  };
  for (int n = 0; n < 36; ++n) fan.push_back({{middle, corner(n), corner(n + 1)}, 0});
  const std::vector<Triangle> whole = with_walls_beyond_faces(fan, box, reach);
  const std::vector<Rim> rims = rims_of(whole);
  ASSERT_EQ(rims.size(), 1u) << "what images share with their walls are the same corners";
  EXPECT_NEAR(seen(whole).low, -reach, 1e-12);
  const double quarter = 0.25 * 36 * 0.5 * std::sin(2 * std::numbers::pi / 36);
  EXPECT_GT(seen(whole).area, quarter + 2 * reach * 0.9);
  EXPECT_LT(seen(whole).area, quarter + 2 * reach + reach * reach);
}

TEST(WallsBeyondFaces, PartsOfACutEdgeMeetInOneCorner) {
  const auto cut = with_walls_beyond_faces(sheet(-0.37, 1), box_with(FaceKind::symmetry, FaceKind::open), reach);
  EXPECT_EQ(rims_of(cut).size(), 1u);
}

TEST(WallsBeyondFaces, EachPatchByItself) {
  std::vector<Triangle> both = sheet(0.1, 1, 0), other = sheet(0, 1, 1);
  both.insert(both.end(), other.begin(), other.end());
  const auto all = with_walls_beyond_faces(both, box_with(FaceKind::symmetry, FaceKind::open), reach);
  const auto area_of = [&](std::uint32_t patch) {
    double area = 0;
    for (const Triangle& t : all) area += t.patch == patch ? t.area().z : 0;
    return area;
  };
  EXPECT_NEAR(area_of(0), 0.9, 1e-12);
  EXPECT_NEAR(area_of(1), 1 + reach, 1e-12);
}

TEST(WallsBeyondFaces, AWallInAFaceHasNoImageAndOneBehindAMirrorIsLeftOut) {
  std::vector<Triangle> upright = {{{Vector3{0, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}, 0}};
  const Box box = box_with(FaceKind::symmetry, FaceKind::open);
  EXPECT_EQ(with_walls_beyond_faces(upright, box, reach), upright);
  for (Vector3& x : upright[0].corner) x.x = -0.1;
  EXPECT_TRUE(with_walls_beyond_faces(upright, box, reach).empty());
}

}  // namespace
}  // namespace talus::continuum
