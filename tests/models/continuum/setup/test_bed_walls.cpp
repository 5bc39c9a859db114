// SPDX-License-Identifier: Apache-2.0
/// The lattice of the bed ends at the walls between which the bed lies, whatever walls there are besides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "models/continuum/setup/bed_walls.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

using testing::IsEmpty;

VesselPart upright_box(std::string name, double width, double depth, double bottom, double top) {
  VesselPart part = named(std::move(name), VesselShape::box);
  part.width = width * spacing, part.depth = depth * spacing, part.bottom = bottom * spacing, part.top = top * spacing;
  return part;
}

/// A bin of 12 by 12 spacings on a shut pyramid; the bed reaches 5 spacings into the bin.
Parameters square_silo() {
  Parameters p = room(20, 20, 40);
  p.gate.opens = GateOpens::when_settled;
  VesselPart hopper = named("hopper", VesselShape::pyramid);
  hopper.lower_width = hopper.lower_depth = 4 * spacing, hopper.upper_width = hopper.upper_depth = 12 * spacing;
  hopper.bottom = 5 * spacing, hopper.top = 11 * spacing;
  VesselPart gate = plate("gate", {8, 8, 5}, {4, 0, 0}, {0, 4, 0});
  gate.gate = true;
  p.vessel = {upright_box("bin", 12, 12, 11, 30), hopper, gate};
  p.bed.height = 11 * spacing;
  return p;
}

/// The four upright sides of a box about the middle of the room.
std::vector<Triangle> sides(double half, double bottom, double top) {
  std::vector<Triangle> triangles;
  const auto corner = [&](int n, double z) {
    return spacing * Vector3{10 + (n % 4 == 1 || n % 4 == 2 ? half : -half), 10 + (n % 4 >= 2 ? half : -half), z};
  };
  for (int n = 0; n < 4; ++n) {
    triangles.push_back({{corner(n, bottom), corner(n, top), corner(n + 1, bottom)}, 0});
    triangles.push_back({{corner(n + 1, bottom), corner(n, top), corner(n + 1, top)}, 0});
  }
  return triangles;
}

VesselPart of_file(std::string name, std::vector<Triangle> triangles) {
  VesselPart part = named(std::move(name), VesselShape::stl);
  part.unit = FileUnit::m;
  part.drawn = std::make_shared<DrawnSurface>(std::move(triangles));
  return part;
}

void expect_same_bed(const Parameters& a, const Parameters& b) {
  ASSERT_THAT(check(a), IsEmpty());
  ASSERT_THAT(check(b), IsEmpty());
  const Layout first = with_level(Layout(a)), second = with_level(Layout(b));
  EXPECT_DOUBLE_EQ(first.lattice.mass, second.lattice.mass);
  EXPECT_DOUBLE_EQ(first.given.bed.height, second.given.bed.height);
  const auto of_first = bed_positions(first), of_second = bed_positions(second);
  ASSERT_EQ(of_first.size(), of_second.size());
  for (std::size_t n = 0; n < of_first.size(); ++n) ASSERT_LT(norm(of_first[n] - of_second[n]), 1e-9 * spacing);
}

TEST(BedWalls, AWallAboveTheBedChangesNothing) {
  const Parameters p = square_silo();
  EXPECT_EQ(lattice_of(Layout(p).given).count, (std::array<std::int64_t, 3>{12, 12, 11}));
  for (const double width : {12.4, 13.3, 21.0}) {  // the widest reaches beyond the box
    Parameters q = p;
    q.vessel.push_back(upright_box("collar", width, 12.6, 30, 35));
    expect_same_bed(p, q);
    Parameters with_mass = p;
    with_mass.bed.mass = 700 * Layout(p).lattice.mass, q.bed.mass = with_mass.bed.mass;
    with_mass.bed.height = q.bed.height = 0;
    expect_same_bed(with_mass, q);
  }
}

TEST(BedWalls, NorDoesOneOutsideThatTheGrainsNeverTouch) {
  const Parameters p = square_silo();
  for (const VesselPart& outside :
       {upright_box("jacket", 13.3, 12.7, 8, 30), plate("flange", {16, 4, 13}, {2.7, 0, 0}, {0, 12, 0})}) {
    Parameters q = p;
    q.vessel.push_back(outside);
    expect_same_bed(p, q);
  }
}

Parameters silo_with_file(std::vector<Triangle> triangles) {
  Parameters p = square_silo();
  p.vessel[0] = of_file("bin", std::move(triangles));
  return p;
}

TEST(BedWalls, NorTheOuterFaceOfASheetInAFile) {
  const Parameters p = silo_with_file(sides(6, 11, 30));
  EXPECT_DOUBLE_EQ(Layout(p).lattice.mass, Layout(square_silo()).lattice.mass);
  std::vector<Triangle> sheet = sides(6, 11, 30);
  for (Triangle t : sides(6.3, 11, 30)) {
    std::swap(t.corner[1], t.corner[2]);
    sheet.push_back(t);
  }
  expect_same_bed(p, silo_with_file(sheet));
}

TEST(BedWalls, OfAFlaringFileWhatLiesInTheHeightsOfTheBedCounts) {
  std::vector<Triangle> flaring = sides(6, 11, 25);
  const auto inwards = [](double x) { return (x < 10 * spacing ? 4 : 16) * spacing; };
  for (Triangle t : sides(7, 25, 30)) {  // turned by 11 degrees: the same smooth part
    for (Vector3& x : t.corner)
      if (x.z < 26 * spacing) x = {inwards(x.x), inwards(x.y), x.z};
    flaring.push_back(t);
  }
  expect_same_bed(silo_with_file(sides(6, 11, 25)), silo_with_file(flaring));
}

TEST(BedWalls, AWiderPlaceThatTheBedReachesCounts) {
  Parameters p = square_silo();
  p.vessel[0].top = 14 * spacing;
  p.vessel.push_back(upright_box("collar", 14, 14, 14, 30));
  for (const auto& [x, y] : {std::pair{3.0, 3.0}, {3.0, 16.0}, {16.0, 3.0}, {16.0, 16.0}})
    p.vessel.push_back(plate("ledge_" + std::to_string(p.vessel.size()), {x, y, 14}, {1, 0, 0}, {0, 1, 0}));
  EXPECT_EQ(Layout(p).lattice.count[0], 14);
  p.bed.height = 8 * spacing;
  EXPECT_EQ(Layout(p).lattice.count[0], 12);
}

TEST(BedWalls, AConeIsAsWideAsTheBinOnIt) {
  Parameters p = shut_silo();
  p.bed.height = 4 * spacing;  // in the cone alone
  const Layout layout(p);
  EXPECT_DOUBLE_EQ(bed_along_x(layout.given).low, 2 * spacing);
  EXPECT_DOUBLE_EQ(bed_along_x(layout.given).high, 14 * spacing);
}

TEST(BedWalls, ADrumIsAsWideAsItIsAnywhere) {
  Parameters p = room(20, 12, 20);
  VesselPart drum = named("drum", VesselShape::cylinder);
  drum.along = Along::y, drum.radius = 7 * spacing, drum.bottom = 2 * spacing, drum.top = 10 * spacing;
  VesselPart front = disc("front_end", 7, 2), rear = disc("rear_end", 7, 10);
  front.along = rear.along = Along::y;
  p.vessel = {drum, front, rear};
  p.bed.height = 4 * spacing, p.bed.inside = {10 * spacing, 6 * spacing, 5 * spacing};
  const Layout layout(p);
  ASSERT_GT(bed_count(layout), 0);
  EXPECT_DOUBLE_EQ(bed_along_x(layout.given).low, 3 * spacing);
  EXPECT_DOUBLE_EQ(bed_along_x(layout.given).high, 17 * spacing);
  EXPECT_DOUBLE_EQ(bed_along_y(layout.given).high, 10 * spacing);
}

TEST(BedWalls, OfASectorTheyAreRound) {
  const Parameters p = silo_of_parts(30);
  Parameters q = p;
  VesselPart collar = named("collar", VesselShape::cylinder);
  collar.radius = 6.7 * spacing, collar.bottom = 26 * spacing, collar.top = 28 * spacing;
  q.vessel.push_back(collar);
  const Layout first(p), second(q);
  EXPECT_EQ(first.lattice.mass, second.lattice.mass);
  EXPECT_EQ(first.lattice.count, second.lattice.count);
}

TEST(BedWalls, WhereGrainsSeeNoneTheFacesBoundTheBed) {
  Parameters p = column(20, 6, 10, 10);
  p.vessel = {plate("left_wall", {3.3, -1, 0}, {0, 8, 0}, {0, 0, 18}),
              plate("right_wall", {13.3, -1, 0}, {0, 8, 0}, {0, 0, 18}),
              plate("belt", {-2, -1, 19}, {30, 0, 0}, {0, 8, 0})};
  p.bed.inside = {8 * spacing, 3 * spacing, 2 * spacing};
  const Layout layout(p);
  EXPECT_DOUBLE_EQ(bed_along_x(layout.given).low, 3.3 * spacing);
  EXPECT_DOUBLE_EQ(bed_along_x(layout.given).high, 13.3 * spacing);
  EXPECT_EQ(bed_along_y(layout.given).low, 0);
  EXPECT_EQ(bed_along_y(layout.given).high, 6 * spacing);
  EXPECT_EQ(bed_count(layout), 10 * 6 * 10);
  p.vessel.erase(p.vessel.begin());
  EXPECT_EQ(bed_along_x(Layout(p).given).low, 0);
}

TEST(BedWalls, SeveralBedsHaveTheWidestInCommon) {
  Parameters p = square_silo();
  p.vessel.push_back(upright_box("collar", 12.4, 12.4, 30, 35));
  TaggedBed upper;
  upper.bottom = 16 * spacing, upper.height = 4 * spacing, upper.inside = {10 * spacing, 10 * spacing, 18 * spacing};
  p.beds = {upper};
  ASSERT_THAT(check(p), IsEmpty());
  const Layout layout(p);
  EXPECT_EQ(layout.lattice.mass, Layout(square_silo()).lattice.mass);
  EXPECT_EQ(layout.with_bed_alone(1).lattice.count[0], 12);
  p.beds[0].bottom = 31 * spacing, p.beds[0].height = 3 * spacing, p.beds[0].inside = {0.1, 0.1, 0.32};
  const Layout wide(p);
  EXPECT_DOUBLE_EQ(bed_along_x(wide.with_bed_alone(0).given).low, 3.8 * spacing) << "the collar's";
  EXPECT_EQ(wide.with_bed_alone(0).lattice.spacing.x, wide.with_bed_alone(1).lattice.spacing.x);
}

}  // namespace
}  // namespace talus::continuum
