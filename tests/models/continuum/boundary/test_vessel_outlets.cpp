// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/vessel_outlets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/continuum/drawn_parts.hpp"
#include "models/continuum/regime.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

VesselPart gate(VesselPart part) {
  part.gate = true;
  return part;
}

/// The value of a line of the card; empty if there is none.
std::string value_of(const Parameters& p, const std::string& quantity) {
  for (const RegimeLine& line : regime_of_case(setup_of(p)))
    if (line.quantity == quantity) return (line.warning ? "! " : "") + line.value;
  return {};
}

/// A room with a slot in a level gate; lengths in spacings.
Parameters slot(double width, double depth) {
  Parameters p = room(60, 60, 60);
  p.box.floor = FaceKind::wall;
  p.vessel = {gate(plate("gate", {30 - width / 2, 30 - depth / 2, 30}, {width, 0, 0}, {0, depth, 0}))};
  return p;
}

TEST(VesselOutlets, TheNarrowerSideCountsWhicheverWayTheyAreTurned) {
  for (const Parameters& p : {slot(30, 8), slot(8, 30)}) {
    const auto outlets = outlets_of_vessel(p);
    ASSERT_FALSE(outlets.empty());
    EXPECT_NEAR(outlets[0].narrow, 8 * spacing, 1e-12);
    EXPECT_NEAR(outlets[0].length, 30 * spacing, 1e-12);
    EXPECT_NEAR(Layout(p).outlet->across, 8 * spacing, 1e-12);
    EXPECT_EQ(value_of(p, "particles across the outlet"), "! 8");
  }
  Parameters p = slot(8, 30);
  p.grains.diameter = spacing;
  EXPECT_EQ(value_of(p, "grains across the outlet"), "! 8");
  const double root = std::sqrt(0.5);
  p.vessel = {gate(plate("gate", {20, 20, 30}, {20 * root, 20 * root, 0}, {-6 * root, 6 * root, 0}))};
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 6 * spacing, 1e-12) << "at 45 degrees";
  EXPECT_NEAR(outlets_of_vessel(p).front().length, 20 * spacing, 1e-12);
}

TEST(VesselOutlets, AGateWiderThanTheHoleAboveItIsTold) {
  const std::string quantity = "share of the outlet with a wall in it or just above";
  const auto told = [&](double hole) {
    Parameters p = slot(20, 60);
    const double width = 30 - hole / 2;
    p.vessel.push_back(plate("left", {0, 0, 30.5}, {width, 0, 0}, {0, 60, 0}));
    p.vessel.push_back(plate("right", {60 - width, 0, 30.5}, {width, 0, 0}, {0, 60, 0}));
    return value_of(p, quantity);
  };
  EXPECT_EQ(told(5), "! 0.75");
  EXPECT_EQ(told(20), "");
}

TEST(VesselOutlets, AWallInThePlaneOfTheGateIsTold) {
  const std::string quantity = "share of the outlet with a wall in it or just above";
  Parameters p = slot(20, 60);
  EXPECT_EQ(value_of(p, quantity), "");
  p.vessel[0].closes_after = 2;
  EXPECT_EQ(value_of(p, quantity), "") << "one that closes again is no wall in its own way";
  p.vessel.push_back(plate("bottom", {0, 0, 30}, {60, 0, 0}, {0, 60, 0}));
  EXPECT_EQ(value_of(p, quantity), "! 1");
}

TEST(VesselOutlets, BetweenMirrorsASlotHasNoEnds) {
  Parameters p = slot(20, 8);
  p.box.depth = 6 * spacing;
  p.vessel = {gate(plate("gate", {20, -1, 30}, {20, 0, 0}, {0, 8, 0}))};
  p.box.front = p.box.rear = FaceKind::symmetry;
  EXPECT_TRUE(outlets_of_vessel(p).front().endless_along_y);
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 20 * spacing, 1e-12);
  p.box.rear = FaceKind::wall;
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 12 * spacing, 1e-12) << "and its image";
  p.box.front = FaceKind::wall;
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 6 * spacing, 1e-12);
  p.vessel.clear();
  p.plate = {.height = 0.3, .slit_left = 0.2, .slit_right = 0.4};
  EXPECT_NEAR(Layout(p).outlet->across, 6 * spacing, 1e-12) << "a slit in a plate likewise";
  p.box.front = p.box.rear = FaceKind::periodic;
  EXPECT_NEAR(Layout(p).outlet->across, 20 * spacing, 1e-12);
}

TEST(VesselOutlets, APlaneOfSymmetryCompletesThem) {
  Parameters p = slot(20, 8);
  p.box.front = FaceKind::symmetry;
  for (const double beyond : {0.0, 1.0, 6.0}) {
    p.vessel = {gate(plate("gate", {20, -beyond, 30}, {14, 0, 0}, {0, 6 + beyond, 0}))};
    const VesselOutlet outlet = outlets_of_vessel(p).front();
    EXPECT_NEAR(outlet.narrow, 12 * spacing, 1e-12) << "drawn " << beyond << " spacings beyond it";
    EXPECT_NEAR(outlet.length, 14 * spacing, 1e-12);
    EXPECT_NEAR(outlet.middle.y, 0, 1e-12);
    EXPECT_NEAR(Layout(p).outlet_width.value_or(0), 12 * spacing, 1e-12);
  }
  p.box.right = FaceKind::symmetry;
  p.vessel = {gate(plate("gate", {55, -1, 30}, {6, 0, 0}, {0, 6, 0}))};
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 10 * spacing, 1e-12) << "a quarter";
  p.box.front = p.box.right = FaceKind::wall;
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 6 * spacing, 1e-12) << "as it is drawn";
}

TEST(VesselOutlets, AGateThatIsLargerThanTheHoleItCoversIsNotTheOutlet) {
  Parameters p = slot(30, 30);
  VesselPart cone = named("cone", VesselShape::cone);
  cone.lower_radius = 4 * spacing, cone.upper_radius = 9 * spacing, cone.bottom = 0.305, cone.top = 0.4;
  p.vessel.insert(p.vessel.begin(), cone);
  const auto outlets = outlets_of_vessel(p);
  ASSERT_FALSE(outlets.empty());
  EXPECT_EQ(outlets[0].name, "gate");
  EXPECT_TRUE(outlets[0].round);
  EXPECT_EQ(outlets[0].narrow, 8 * spacing);
  EXPECT_EQ(outlets[0].middle.z, 0.3) << "grains on the gate are above it";
  p.vessel[0].bottom = 0.35;
  EXPECT_FALSE(outlets_of_vessel(p).front().round) << "not that of a cone five spacings above";
}

TEST(VesselOutlets, TheRimOfAFileThatAGateCoversIsTheOutlet) {
  Parameters p = slot(30, 30);
  VesselPart cone = named("cone", VesselShape::cone);
  cone.lower_radius = 4 * spacing, cone.upper_radius = 9 * spacing, cone.bottom = 0.3, cone.top = 0.4;
  Parameters alone = p;
  alone.vessel = {cone};
  p.vessel.push_back(drawn("funnel", triangles_of(alone, 0)));
  EXPECT_TRUE(outlets_of_vessel(p).front().round);
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 8 * spacing, 1e-9) << "the polygon's area is the circle's";
  VesselPart pyramid = named("pyramid", VesselShape::pyramid);
  pyramid.lower_width = 0.1, pyramid.lower_depth = 0.06, pyramid.upper_width = pyramid.upper_depth = 0.2;
  pyramid.bottom = 0.3, pyramid.top = 0.4;
  alone.vessel = {pyramid};
  p.vessel[1] = drawn("funnel", triangles_of(alone, 0));
  EXPECT_FALSE(outlets_of_vessel(p).front().round);
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 0.06, 1e-12);
  p.vessel[1].move[2] = 0.1;
  EXPECT_NEAR(outlets_of_vessel(p).front().narrow, 0.3, 1e-12) << "above the gate";
}

TEST(VesselOutlets, SeveralHaveARowEach) {
  Parameters p = slot(14, 14);
  p.vessel[0] = gate(plate("west", {10, 20, 30}, {14, 0, 0}, {0, 14, 0}));
  p.vessel.push_back(gate(plate("east", {40, 40, 20}, {16, 0, 0}, {0, 6, 0})));
  const auto outlets = outlets_of_vessel(p);
  ASSERT_EQ(outlets.size(), 2u);
  EXPECT_EQ(outlets[0].name, "east") << "the lowest first";
  EXPECT_EQ(outlets_of_vessel(p).front().name, "east");
  EXPECT_EQ(value_of(p, "particles across the outlet east"), "! 6");
  EXPECT_EQ(value_of(p, "particles across the outlet west"), "14");
  EXPECT_EQ(value_of(p, "particles across the outlet"), "");
  EXPECT_NEAR(Layout(p).outlet->middle_y, 43 * spacing, 1e-12) << "it is not in the middle of the box";
  EXPECT_TRUE(outlets[1].is_beside({0.17, 0.27, 0}, 0));
  EXPECT_FALSE(outlets[1].is_beside({0.17, 0.37, 0}, spacing));

  p.vessel = {named("a", VesselShape::pyramid), named("b", VesselShape::pyramid), named("c", VesselShape::cone)};
  for (std::size_t n = 0; n < 2; ++n) {
    p.vessel[n].lower_width = p.vessel[n].lower_depth = 0.1, p.vessel[n].bottom = 0.2, p.vessel[n].top = 0.3;
    p.vessel[n].centre = {0.15 + 0.3 * static_cast<double>(n), 0.3};
  }
  p.vessel[2].lower_radius = 0.1, p.vessel[2].bottom = 0.4, p.vessel[2].top = 0.5;
  EXPECT_EQ(outlets_of_vessel(p).size(), 2u) << "the cone ends above both";
}

TEST(VesselOutlets, AWallCloseBelowIsTold) {
  Parameters p = slot(20, 10);
  EXPECT_EQ(share_blocked_below(Layout(p), outlets_of_vessel(p).front()), 0);
  EXPECT_EQ(value_of(p, "share of the outlet with a wall below"), "");
  p.vessel.push_back(plate("shelf", {20, 20, 25}, {10, 0, 0}, {0, 20, 0}));
  EXPECT_NEAR(share_blocked_below(Layout(p), outlets_of_vessel(p).front()), 0.5, 1e-12);
  EXPECT_EQ(value_of(p, "share of the outlet with a wall below"), "! 0.5");
  p.vessel[1].corner[2] = 0.15;
  EXPECT_EQ(share_blocked_below(Layout(p), outlets_of_vessel(p).front()), 0) << "farther than it is across";
  p.vessel.pop_back();
  p.vessel[0].corner[2] = 0.09;
  EXPECT_EQ(share_blocked_below(Layout(p), outlets_of_vessel(p).front()), 1) << "the floor of the box";
  p.box.floor = FaceKind::open;
  EXPECT_EQ(share_blocked_below(Layout(p), outlets_of_vessel(p).front()), 0);
}

}  // namespace
}  // namespace talus::continuum
