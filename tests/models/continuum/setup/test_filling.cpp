// SPDX-License-Identifier: Apache-2.0
/// How high bed.mass may reach.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/setup/layout.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Plates of a hopper from face to face, on which the box goes on.
Parameters hopper_in_a_box() {
  Parameters p = column(20, 4, 0, 40);
  p.box.front = p.box.rear = FaceKind::symmetry, p.box.floor = FaceKind::open;
  p.gate.opens = GateOpens::when_settled;
  p.vessel = {plate("left_plate", {8, -1, 5}, {-8, 0, 12}, {0, 6, 0}),
              plate("right_plate", {12, -1, 5}, {8, 0, 12}, {0, 6, 0}),
              plate("gate", {8, -1, 5}, {4, 0, 0}, {0, 6, 0})};
  p.vessel[2].gate = true;
  return p;
}

TEST(BedMass, GoesOnBetweenFacesOfTheBoxAboveTheVessel) {
  Parameters p = hopper_in_a_box();
  p.bed.height = 24 * spacing;
  const Layout given(p);
  const double mass = given.lattice.mass * bed_count(given);
  p.bed.height = 0, p.bed.mass = mass;
  ASSERT_THAT(check(p), IsEmpty());
  EXPECT_NEAR(with_level(Layout(p)).given.bed.height, 24 * spacing, 1e-9);
  p.bed.mass = 10 * mass;
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "bed.mass");
}

TEST(BedMass, GoesUpFromLevelWalls) {
  Parameters p = hopper_in_a_box();
  p.vessel = {plate("base", {0, 0, 5}, {20, 0, 0}, {0, 4, 0})};
  p.vessel[0].gate = true;
  p.bed.mass = bulk_density(p) * 20 * 4 * 12 * spacing * spacing * spacing;
  ASSERT_THAT(check(p), IsEmpty());
  EXPECT_NEAR(with_level(Layout(p)).given.bed.height, 12 * spacing, 1e-9);
  p.bed.bottom = 39.5 * spacing;
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "bed.mass");
  EXPECT_THAT(problems[0].what, HasSubstr("no layer has room"));
}

TEST(BedMass, NothingFollowsOfAFileThatCannotBeRead) {
  Parameters p = hopper_in_a_box();
  p.vessel = {named("silo", VesselShape::stl)};
  p.bed.mass = 1e6;
  EXPECT_THAT(check_mass(with_level(Layout(p))), IsEmpty());
}

TEST(BedMass, EndsAtTheTopOfAVesselThatAPlaneOfSymmetryCuts) {
  Parameters p = column(10, 16, 0, 40);
  p.box.left = FaceKind::symmetry, p.gate.opens = GateOpens::when_settled;
  VesselPart half = named("half", VesselShape::cylinder);
  half.centre = {0, 8 * spacing}, half.radius = 6 * spacing, half.bottom = 5 * spacing, half.top = 15 * spacing;
  VesselPart gate = disc("gate", 6, 5);
  gate.centre = half.centre, gate.gate = true;
  p.vessel = {half, gate};
  p.bed.mass = bulk_density(p) * 0.5 * M_PI * 36 * 12 * spacing * spacing * spacing;
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].what, HasSubstr("more than there is room for"));
}

}  // namespace
}  // namespace talus::continuum
