// SPDX-License-Identifier: Apache-2.0
/// The patches of a boundary: their friction, gates and motion as the keys of a case give them.
#include "models/continuum/boundary/boundary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

std::vector<std::string> names(const Boundary& boundary) {
  std::vector<std::string> all;
  for (const Patch& patch : boundary.patches()) all.push_back(patch.name);
  return all;
}

/// A slice between planes of symmetry through an upright box whose front and rear lie just behind them.
TEST(Boundary, HasNoWallBehindAPlaneOfSymmetry) {
  Parameters p = room(12, 4, 12);
  p.box.front = p.box.rear = FaceKind::symmetry;
  VesselPart bin = named("bin", VesselShape::box);
  bin.centre = {6 * spacing, 2 * spacing}, bin.width = 8 * spacing, bin.depth = 4.2 * spacing, bin.top = 10 * spacing;
  p.vessel = {bin};
  const Boundary sliced(p);
  const Vector3 middle{6 * spacing, 0.4 * spacing, 5 * spacing};
  EXPECT_FALSE(sliced.vessel().nearest(middle, spacing));
  EXPECT_TRUE(sliced.vessel().blocks(middle, {0, middle.y, middle.z})) << "the walls across the slice stay";
  p.box.front = p.box.rear = FaceKind::open;
  EXPECT_TRUE(Boundary(p).vessel().nearest(middle, spacing));
}

TEST(Boundary, HasAPatchForEachFacePlateAndPartOfTheVessel) {
  Parameters p = room(12, 12, 12);
  p.walls.friction = Friction::coulomb, p.walls.coefficient = 0.3;
  p.plates = {{.from = {0.02, 0.02}, .to = {0.06, 0.05}, .openings = {}, .opens_after = {}}};
  p.vessel = {disc("bottom", 4, 2), disc("", 4, 4)};
  p.vessel[1].friction = 0.5;
  const Boundary boundary(p);
  EXPECT_THAT(names(boundary),
              testing::ElementsAre("left", "right", "front", "rear", "floor", "top", "plates_1", "bottom", "disc_2"));
  EXPECT_EQ(boundary.patch_of_part(1), 8u);
  EXPECT_EQ(boundary.patches()[6].friction, 0.3);
  EXPECT_EQ(boundary.patches()[7].friction, 0.3) << "the case's";
  EXPECT_EQ(boundary.patches()[8].friction, 0.5) << "its own";
  EXPECT_TRUE(boundary.bears_load(8));
  EXPECT_FALSE(boundary.bears_load(5)) << "open";
  for (const Patch& patch : boundary.patches()) EXPECT_FALSE(patch.motion) << patch.name;
  p.walls.friction = Friction::none;
  const Boundary smooth(p);
  for (const Patch& patch : smooth.patches()) EXPECT_EQ(patch.friction, 0) << patch.name;
}

TEST(Boundary, OpensItsGatesWhenTheyAreDueAndACopyHasItsOwn) {
  Parameters p = room(12, 12, 12);
  p.gate.opens = GateOpens::at_time;
  p.vessel = {disc("first", 4, 2), disc("second", 4, 4), disc("wall", 4, 6)};
  p.vessel[0].gate = p.vessel[1].gate = true;
  p.vessel[1].opens_after = 2;
  const Boundary shut(p);
  Boundary boundary = shut;
  EXPECT_FALSE(boundary.has_gates_due(-1));
  EXPECT_TRUE(boundary.has_gates_due(1));
  boundary.move_gates(1);
  EXPECT_EQ(boundary.openings(), 1);
  EXPECT_TRUE(boundary.vessel().is_open(0));
  EXPECT_FALSE(boundary.has_gates_due(1)) << "opened";
  EXPECT_TRUE(boundary.has_gates_due(2));
  boundary.move_gates(2);
  EXPECT_EQ(boundary.openings(), 2);
  EXPECT_FALSE(boundary.vessel().is_open(2)) << "no gate";
  EXPECT_EQ(shut.openings(), 0);
  EXPECT_EQ(shut.vessel().triangles().data(), boundary.vessel().triangles().data()) << "made once";
}

TEST(Boundary, ShutsGatesAgainWhenTheyAreDue) {
  Parameters p = room(12, 12, 12);
  p.vessel = {disc("first", 4, 2), disc("second", 4, 4)};
  p.vessel[0].gate = p.vessel[1].gate = true;
  p.vessel[0].closes_after = 3;
  Boundary boundary(p);
  EXPECT_FALSE(boundary.shut_since(-1)) << "not opened yet";
  EXPECT_FALSE(boundary.shut_since(4)) << "the second stays away";
  boundary.move_gates(1);
  EXPECT_TRUE(boundary.vessel().is_open(0) && boundary.vessel().is_open(1));
  EXPECT_FALSE(boundary.has_gates_due(2));
  EXPECT_TRUE(boundary.has_gates_due(3));
  boundary.move_gates(3);
  EXPECT_FALSE(boundary.vessel().is_open(0));
  EXPECT_TRUE(boundary.vessel().is_open(1));
  p.vessel[1].closes_after = 5;
  EXPECT_EQ(Boundary(p).shut_since(9), 5);
  p.vessel[1].opens_after = 4, p.vessel[1].repeats_every = 3;
  EXPECT_EQ(Boundary(p).shut_since(12.5), 11);
  EXPECT_FALSE(Boundary(p).shut_since(10.5)) << "open again";
  for (const auto& [time, away] :
       {std::pair(3.9, false), {4, true}, {4.9, true}, {5, false}, {6.9, false}, {7, true}, {8, false}}) {
    boundary = Boundary(p), boundary.move_gates(time);
    EXPECT_EQ(boundary.vessel().is_open(1), away) << time;
  }
}

TEST(Layout, KeepsItsBoundaryForOtherBeds) {
  Parameters p = room(12, 12, 12);
  p.bed.height = 2 * spacing;
  p.vessel = {disc("bottom", 4, 2)};
  const Layout layout(p);
  p.bed.height = 4 * spacing;
  const Layout higher = layout.with(p);
  EXPECT_EQ(higher.boundary, layout.boundary);
  EXPECT_EQ(higher.depth, 4 * spacing);
}

}  // namespace
}  // namespace talus::continuum
