// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/bed_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "models/continuum/drawn_parts.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

/// An upright square duct of a file from z = 4 to 20 spacings, 2 to 12 along x and y, in squares of two spacings, those
/// of the wall towards x = 12 left out whose numbers along y and z are given.
std::vector<Triangle> duct(const std::vector<std::array<int, 2>>& holes = {}) {
  std::vector<Triangle> triangles;
  for (int wall = 0; wall < 4; ++wall)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 8; ++k) {
        if (wall == 0 && std::find(holes.begin(), holes.end(), std::array{j, k}) != holes.end()) continue;
        const auto at = [&](int along, int up) {
          const double a = 2 + 2.0 * (j + along), z = 4 + 2.0 * (k + up);
          return spacing * (wall == 0   ? Vector3{12, a, z}
                            : wall == 1 ? Vector3{2, a, z}
                            : wall == 2 ? Vector3{a, 2, z}
                                        : Vector3{a, 12, z});
        };
        triangles.push_back({{at(0, 0), at(1, 0), at(1, 1)}, 0});
        triangles.push_back({{at(0, 0), at(1, 1), at(0, 1)}, 0});
      }
  return triangles;
}

Parameters filled(std::vector<Triangle> triangles) {
  Parameters p = room(14, 14, 24);
  p.box.floor = FaceKind::wall;
  p.bed.bottom = 4 * spacing, p.bed.height = 12 * spacing;
  p.vessel = {drawn("duct", std::move(triangles)), plate("lid", {2, 2, 4}, {10, 0, 0}, {0, 10, 0})};
  p.vessel[1].gate = true;
  return p;
}

TEST(OpenRims, TheTopOfAVesselAndAnOutletOnAGateAreNone) {
  EXPECT_THAT(rims_below_bed(Layout(filled(duct()))), testing::IsEmpty());
  Parameters p = filled(duct());
  p.vessel.push_back(drawn("baffle", {{{Vector3{0.07, 0.04, 0.06}, {0.07, 0.1, 0.06}, {0.07, 0.07, 0.1}}, 0}}));
  EXPECT_THAT(rims_below_bed(Layout(p)), testing::IsEmpty()) << "grains are on both sides of a plate within the bed";
}

TEST(OpenRims, AHoleBelowTheTopOfTheBedIsOne) {
  const auto rims = rims_below_bed(Layout(filled(duct({{1, 2}, {2, 2}}))));
  ASSERT_EQ(rims.size(), 1u);
  EXPECT_EQ(rims[0].part, 0u);
  EXPECT_LT(norm(rims[0].middle - spacing * Vector3{12, 6, 9}), 1e-9);
  EXPECT_NEAR(rims[0].length, 4 * spacing, 1e-9);
  EXPECT_NEAR(rims[0].width, 2 * spacing, 1e-9);
  EXPECT_THAT(rims_below_bed(Layout(filled(duct({{1, 7}, {2, 6}})))), testing::IsEmpty()) << "above the bed";
}

TEST(OpenRims, WhatCoversAHoleClosesIt) {
  Parameters p = filled(duct({{1, 2}, {2, 2}}));
  p.vessel.push_back(plate("patch", {12, 3, 7}, {0, 6, 0}, {0, 0, 4}));
  EXPECT_THAT(rims_below_bed(Layout(p)), testing::IsEmpty());
  p.vessel.back().first_edge[1] = 3 * spacing;
  EXPECT_EQ(rims_below_bed(Layout(p)).size(), 1u) << "half of it";
  p.vessel.pop_back();
  p.box.width = 12 * spacing, p.box.right = FaceKind::wall;
  EXPECT_THAT(rims_below_bed(Layout(p)), testing::IsEmpty()) << "a face of the box";
}

TEST(OpenRims, AnOutletWithoutAGateIsOne) {
  Parameters p = filled(duct());
  p.vessel.pop_back();
  const auto rims = rims_below_bed(Layout(p));
  ASSERT_EQ(rims.size(), 1u);
  EXPECT_NEAR(rims[0].middle.z, 4 * spacing, 1e-9);
  EXPECT_NEAR(rims[0].length, 10 * spacing, 1e-9);
  EXPECT_NEAR(rims[0].width, 10 * spacing, 1e-9);
}

TEST(OpenRims, ABedThatDoesNotSettleSaysHowManyHaveLeft) {
  Parameters p = filled(duct());
  make_granular(p);
  p.vessel[1].gate = false;
  p.vessel[1].first_edge[0] = 5 * spacing;  // half of the floor
  p.gate.opens = GateOpens::when_settled;
  p.settle = {.speed = 1e-3, .duration = 0.01, .max_time = 0.1, .loading_time = 0.0, .damping_time = {}};
  p.integration.method = Method::leapfrog;
  ThreadTeam team(2);
  Continuum model = started(p, team);
  std::string told;
  try {
    while (model.state().time < 0.2) model.advance(team);
  } catch (const NumericalError& error) {
    told = error.what();
  }
  EXPECT_THAT(told, testing::HasSubstr("the bed is still moving after"));
  EXPECT_THAT(told, testing::ContainsRegex("faster than settle.speed, [1-9][0-9]* have left the vessel"));
  EXPECT_THAT(told, testing::HasSubstr("first a wall, lid or gate where the vessel is open"));
}

}  // namespace
}  // namespace talus::continuum
