// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/wall_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/drawn_parts.hpp"
#include "small_silo.hpp"

namespace talus::app {
namespace {

TEST(WallLoads, BandsAreThoseOfTheWalls) {
  const std::vector<BandOfWall> bands = bands_of(continuum::Layout(small_silo()));
  ASSERT_EQ(bands.size(), 8u + 3u + 1u);
  EXPECT_EQ(bands[0].name, "cylinder.1");
  EXPECT_TRUE(bands[0].is_upright());
  EXPECT_NEAR(bands[8].sine, 0.5, 1e-3) << "the cone";
  EXPECT_NEAR(bands.back().area, continuum::half_turn * std::pow(0.03 - 0.03 * std::tan(continuum::half_turn / 6), 2),
              1e-9);
}

TEST(WallLoads, BandsOfAConeHaveTheAreaOfTheirHeights) {
  continuum::Parameters p = small_silo();
  for (const double spacing : {2.5e-3, 3e-3, 4e-3}) {
    p.bed.spacing = spacing;
    double border = 0.06;
    for (const BandOfWall& band : bands_of(continuum::Layout(p))) {
      if (!band.name.starts_with("cone")) continue;
      EXPECT_EQ(band.low, border) << band.name;
      border = band.high;
      const auto radius = [&](double z) { return p.vessel[1].lower_radius + (z - 0.06) / std::sqrt(3.0); };
      const double slant = (band.high - band.low) * 2 / std::sqrt(3.0);
      EXPECT_NEAR(band.area, continuum::half_turn * (radius(band.low) + radius(band.high)) * slant, 0.005 * band.area)
          << band.name << " at " << spacing;
    }
    EXPECT_EQ(border, 0.09);
  }
}

/// A bin of 60 by 60 by 90 mm, of sheets of 1 mm with both their faces, in one file, or of their inner faces.
std::vector<Triangle> walls_of_bin(bool has_both_faces, bool has_divider = false) {
  using continuum::sheet;
  const double a = 0.02, b = 0.08, w = 0.06, h = 0.09;
  const Vector3 up{0, 0, h};
  std::vector sheets{sheet({a, a, 0.02}, {0, w, 0}, up, 1e-3), sheet({b, b, 0.02}, {0, -w, 0}, up, 1e-3),
                     sheet({b, a, 0.02}, {-w, 0, 0}, up, 1e-3), sheet({a, b, 0.02}, {w, 0, 0}, up, 1e-3),
                     sheet({a, a, 0.02}, {w, 0, 0}, {0, w, 0}, 1e-3)};
  if (has_divider) sheets.push_back(sheet({0.05, a, 0.02}, {0, w, 0}, up, 1e-3));
  std::vector<Triangle> all;
  for (std::vector<Triangle>& wall : sheets) {
    if (!has_both_faces) wall.resize(2);
    all.insert(all.end(), wall.begin(), wall.end());
  }
  return all;
}

continuum::Parameters drawn_bin(std::vector<Triangle> walls) {
  continuum::Parameters p = small_silo();
  p.vessel = {continuum::drawn("bin", std::move(walls))};
  p.bed.bottom = 0.02, p.bed.height = 0.05;
  p.bed.inside = {0.03, 0.05, 0.04};
  return p;
}

TEST(WallLoads, OfASheetWithBothFacesAreOnTheFaceThatTheGrainsSee) {
  const std::vector<BandOfWall> one = bands_of(continuum::Layout(drawn_bin(walls_of_bin(false)))),
                                both = bands_of(continuum::Layout(drawn_bin(walls_of_bin(true))));
  ASSERT_GT(one.size(), 3u);
  double of_one = 0, of_both = 0;
  for (const BandOfWall& band : one) of_one += band.area;
  for (const BandOfWall& band : both) of_both += band.area;
  EXPECT_NEAR(of_one, 4 * 0.06 * 0.09 + 0.06 * 0.06, 1e-6);
  EXPECT_NEAR(of_both, of_one, 0.06 * of_one) << "rims are a part";
}

/// Normals of a file may be on either side.
TEST(WallLoads, OfABinWithADividerAreOnAllOfItsWallsWhicheverWayTheirNormalsPoint) {
  for (const bool is_turned : {false, true}) {
    std::vector<Triangle> walls = walls_of_bin(false, true);
    if (is_turned)
      for (Triangle& wall : walls) std::swap(wall.corner[1], wall.corner[2]);
    continuum::Parameters p = drawn_bin(std::move(walls));
    p.inlets.emplace_back().centre = {0.065, 0.05, 0.09};
    double area = 0;
    for (const BandOfWall& band : bands_of(continuum::Layout(p))) area += band.area;
    EXPECT_NEAR(area, 5 * 0.06 * 0.09 + 0.06 * 0.06, 1e-6) << is_turned;
  }
}

}  // namespace
}  // namespace talus::app
