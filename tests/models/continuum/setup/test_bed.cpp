// SPDX-License-Identifier: Apache-2.0
/// Where the bed lies: its seed, its bounds, particles of a file, what is said of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "models/continuum/bed_cases.hpp"
#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Triangle> box_of(const Vector3& a, const Vector3& b) {
  const Vector3 c[8] = {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z},
                        {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}};
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::vector<Triangle> triangles;
  for (const auto& f : faces) {
    triangles.push_back({{c[f[0]], c[f[1]], c[f[2]]}, 0});
    triangles.push_back({{c[f[0]], c[f[2]], c[f[3]]}, 0});
  }
  return triangles;
}

VesselPart drawn(std::string name, std::vector<Triangle> triangles) {
  VesselPart part = named(std::move(name), VesselShape::stl);
  part.unit = FileUnit::m;
  part.drawn = std::make_shared<DrawnSurface>(std::move(triangles));
  return part;
}

TEST(Bed, LiesAboveTheGateWhereverTheMiddleOfAllWallsIs) {
  Parameters p = beside_a_silo();
  ASSERT_THAT(check(p), IsEmpty());
  const auto bed = bed_positions(Layout(p));
  EXPECT_NEAR(double(bed.size()), M_PI * 36 * 10, 60);
  EXPECT_EQ(count_within(bed, 10, 10, 6), bed.size());
  EXPECT_THAT(warnings(p), IsEmpty());
  p.bed.mass = 500 * lattice_of(p).mass;
  const auto of_mass = bed_positions(Layout(with_level(Layout(p)).given));
  EXPECT_EQ(of_mass.size(), 500u);
  EXPECT_EQ(count_within(of_mass, 10, 10, 6), 500u);
}

TEST(Bed, LiesAboveTheOutletOfAVesselWithoutAGate) {
  Parameters p = beside_a_silo();
  p.vessel[1] = named("funnel", VesselShape::cone);
  p.vessel[1].centre = {10 * spacing, 10 * spacing};
  p.vessel[1].bottom = 14 * spacing, p.vessel[1].top = 20 * spacing;
  p.vessel[1].lower_radius = 3 * spacing, p.vessel[1].upper_radius = 6 * spacing;
  const auto bed = bed_positions(Layout(p));
  EXPECT_GT(bed.size(), 1000u);
  EXPECT_EQ(count_within(bed, 10, 10, 6), bed.size());
}

TEST(Bed, LiesAboveEveryGate) {
  Parameters p = beside_a_silo();
  p.vessel[2] = tube("other", 40, 10, 4, 20, 45);
  p.vessel.push_back(gate_at(40, 10, 4, 20));
  p.vessel.back().name = "gate_2";
  const auto bed = bed_positions(Layout(p));
  EXPECT_EQ(count_within(bed, 10, 10, 6) + count_within(bed, 40, 10, 4), bed.size());
  EXPECT_NEAR(double(count_within(bed, 40, 10, 4)), M_PI * 16 * 10, 60);
}

TEST(Bed, BeginsAtThePlaceInside) {
  Parameters p = beside_a_silo();
  p.vessel[2] = tube("other", 40, 10, 4, 20, 45);
  p.bed.inside = {40 * spacing, 10 * spacing, 42 * spacing};  // above the bed's top: the same column
  ASSERT_THAT(check(p), IsEmpty());
  const auto bed = bed_positions(Layout(p));
  EXPECT_EQ(count_within(bed, 40, 10, 4), bed.size());
  EXPECT_NEAR(double(bed.size()), M_PI * 16 * 10, 60);
  EXPECT_THAT(warnings(p), testing::Contains("gate without grains"));
}

TEST(Bed, APlaceInsideThatIsNoneIsAFault) {
  Parameters p = beside_a_silo();
  const auto told = [&](std::array<double, 3> x) {
    p.bed.inside = {x[0] * spacing, x[1] * spacing, x[2] * spacing};
    const auto problems = check(p);
    return problems.size() == 1 ? problems[0].key + ": " + problems[0].what : std::to_string(problems.size());
  };
  EXPECT_EQ(told({10, 10, 60}), "bed.inside: is not within the box");
  EXPECT_EQ(told({1, 10, 25}), "bed.inside: is not where the bed may lie");
  EXPECT_EQ(told({10, 10, 19}), "bed.inside: is not where the bed may lie");
}

/// The middle of its top is outside: a U of three closed boxes would be, a ring of square section is.
TEST(Bed, FillsTheInsideOfAClosedSurface) {
  // A ring: a large box and a smaller one in it, both closed; between them is the inside.
  std::vector<Triangle> ring =
      box_of({5 * spacing, 5 * spacing, 5 * spacing}, {25 * spacing, 25 * spacing, 15 * spacing});
  for (Triangle t : box_of({10 * spacing, 10 * spacing, 5 * spacing}, {20 * spacing, 20 * spacing, 15 * spacing})) {
    std::swap(t.corner[1], t.corner[2]);
    ring.push_back(t);
  }
  Parameters p = room(30, 30, 20);
  p.vessel = {drawn("ring", ring)};
  p.bed.bottom = 5 * spacing, p.bed.height = 10 * spacing;
  EXPECT_EQ(bed_positions(Layout(p)).size(), 10u * 10 * 10) << "by default the hole of the ring";
  p.bed.inside = {7 * spacing, 7 * spacing, 7 * spacing};
  ASSERT_THAT(check(p), IsEmpty());
  EXPECT_EQ(bed_positions(Layout(p)).size(), (20u * 20 - 10 * 10) * 10);
  EXPECT_THAT(warnings(p), IsEmpty());
}

TEST(Bed, PlatesTooBoundItsRegion) {
  Parameters p = column(20, 4, 10, 4);
  p.plates = {{.from = {8 * spacing, 0}, .to = {8 * spacing, 14 * spacing}, .openings = {}, .opens_after = {}}};
  EXPECT_EQ(bed_positions(Layout(p)).size(), 12u * 4 * 10);
  p.bed.inside = {3 * spacing, 2 * spacing, 5 * spacing};
  EXPECT_EQ(bed_positions(Layout(p)).size(), 8u * 4 * 10);
}

TEST(Bed, EndsAtItsFrontAndRear) {
  Parameters p = column(10, 12, 5, 2);
  p.bed.front = 2 * spacing, p.bed.rear = 9 * spacing, p.bed.left = 4 * spacing;
  ASSERT_THAT(check(p), IsEmpty());
  const auto bed = bed_positions(Layout(p));
  EXPECT_EQ(bed.size(), 6u * 7 * 5);
  for (const Vector3& x : bed) {
    EXPECT_GT(x.y, 2 * spacing);
    EXPECT_LT(x.y, 9 * spacing);
  }
  p.bed.rear = 1 * spacing;
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u) << "no faults that follow";
  EXPECT_EQ(problems[0].key, "bed.rear");
}

/// A bed left of a sluice in a channel: bed.left is by default the sluice's.
TEST(Bed, AnEndBeforeTheDefaultBeginningNamesIt) {
  Parameters p = column(50, 6, 10, 5);
  p.gate.opens = GateOpens::when_settled;
  p.vessel = {plate("sluice", {12, -0.5, 0}, {0, 7, 0}, {0, 0, 15}),
              plate("obstacle", {28, -0.5, 0}, {0, 3, 0}, {0, 0, 10})};
  p.vessel[0].gate = true;
  p.bed.right = 12 * spacing;
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u) << "nothing of bed.spacing follows";
  EXPECT_EQ(problems[0].key, "bed.right");
  EXPECT_EQ(problems[0].what,
            "leaves no bed within the box: from 120 mm (bed.left by default, the least x of the vessel) to 120 mm "
            "(bed.right)");
  EXPECT_THAT(problems[0].allowed, HasSubstr("give bed.left as well"));
  p.bed.left = 0;
  ASSERT_THAT(check(p), IsEmpty());
  EXPECT_EQ(bed_positions(Layout(p)).size(), 12u * 6 * 10);
  EXPECT_THAT(warnings(p), IsEmpty()) << "faces of the box hold it";
}

TEST(BedReport, SaysWhereTheBedLiesAndWhatHoldsIt) {
  const Parameters p = beside_a_silo();
  const BedReport report = report_of_bed(Layout(p));
  EXPECT_EQ(report.particles, double(bed_positions(Layout(p)).size()));
  EXPECT_NEAR(report.mass, report.particles * lattice_of(p).mass, 1e-12);
  EXPECT_NEAR(report.low.x, 4 * spacing, 0.7 * spacing);
  EXPECT_NEAR(report.high.x, 16 * spacing, 0.7 * spacing);
  EXPECT_NEAR(report.low.z, 20 * spacing, 1e-9);
  EXPECT_NEAR(report.high.z, 30 * spacing, 1e-9);
  EXPECT_THAT(report.beside, testing::ElementsAre("silo", "gate"));
  Parameters box = column(8, 4, 5);
  EXPECT_THAT(report_of_bed(Layout(box)).beside,
              testing::ElementsAre("left face", "right face", "front face (symmetry)", "rear face (symmetry)", "floor",
                                   "top (open)"));
}

TEST(BedReport, TellsOfABedOutsideTheVessel) {
  Parameters p = beside_a_silo();
  p.vessel[1].gate = false, p.vessel[1].name = "bottom";  // nothing says which of the rooms is meant
  EXPECT_THAT(warnings(p), testing::ElementsAre("bed outside the vessel"));
  p.bed.inside = {10 * spacing, 10 * spacing, 25 * spacing};
  EXPECT_THAT(warnings(p), IsEmpty());
}

/// A box as an STL file, without its lid, in which two triangles of a side are missing.
TEST(BedReport, FindsTheHoleThatTheRegionPassesOutThrough) {
  Parameters p = room(30, 30, 30);
  std::vector<Triangle> triangles;
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    triangles.push_back({{spacing * a, spacing * b, spacing * c}, 0});
    triangles.push_back({{spacing * a, spacing * c, spacing * d}, 0});
  };
  add({5, 5, 5}, {25, 5, 5}, {25, 25, 5}, {5, 25, 5});
  add({5, 5, 5}, {5, 25, 5}, {5, 25, 28}, {5, 5, 28});
  add({5, 25, 5}, {25, 25, 5}, {25, 25, 28}, {5, 25, 28});
  add({5, 5, 5}, {5, 5, 28}, {25, 5, 28}, {25, 5, 5});
  p.vessel = {drawn("tank", triangles)};
  // The side at x = 25 around a hole of three by three spacings.
  const auto side = [&](double y0, double y1, double z0, double z1) {
    add({25, y0, z0}, {25, y0, z1}, {25, y1, z1}, {25, y1, z0});
  };
  side(5, 18, 5, 28), side(21, 25, 5, 28), side(18, 21, 5, 12), side(18, 21, 15, 28);
  p.vessel = {drawn("tank", triangles)};
  p.bed.height = 20 * spacing;
  const auto lines = regime_of_bed(Layout(p));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].quantity, "way out of the vessel");
  double x = 0, y = 0, z = 0;
  ASSERT_EQ(std::sscanf(lines[0].value.c_str(), "(%lf, %lf, %lf) mm", &x, &y, &z), 3);
  EXPECT_NEAR(x, 250, 15);
  EXPECT_NEAR(y, 195, 15);
  EXPECT_NEAR(z, 135, 15);
  p.bed.height = 6 * spacing;
  EXPECT_THAT(warnings(p), IsEmpty()) << "below the hole";
}

TEST(BedReport, TellsOfAForgottenGateAndOfABedAboveTheRim) {
  Parameters p = beside_a_silo();
  p.vessel.pop_back(), p.vessel.pop_back();
  p.vessel.push_back(named("funnel", VesselShape::cone));
  p.vessel[1].centre = {10 * spacing, 10 * spacing};
  p.vessel[1].bottom = 14 * spacing, p.vessel[1].top = 20 * spacing;
  p.vessel[1].lower_radius = 3 * spacing, p.vessel[1].upper_radius = 6 * spacing;
  p.bed.bottom = std::nullopt;
  const auto lines = regime_of_bed(Layout(p));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].quantity, "way out of the vessel");
  EXPECT_THAT(lines[0].value, testing::AnyOf(HasSubstr("145) mm"), HasSubstr("135) mm"))) << "the outlet";
  p.gate.opens = GateOpens::from_the_start;
  EXPECT_THAT(warnings(p), IsEmpty()) << "it is to flow";
  p.bed.height = 34 * spacing;  // three above the rim
  EXPECT_THAT(warnings(p), testing::ElementsAre("way out of the vessel"));
}

GivenBed grid_of(int count) {
  GivenBed bed;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) bed.position.push_back({(i + 0.5) * spacing, (j + 0.5) * spacing, 2.5 * spacing});
  bed.low = {0.5 * spacing, 0.5 * spacing, 2.5 * spacing};
  bed.high = {(count - 0.5) * spacing, (count - 0.5) * spacing, 2.5 * spacing};
  return bed;
}

Parameters with_bed(GivenBed bed) {
  Parameters p = column(6, 6, 1, 9);
  p.bed.height = 0;
  p.bed.file = "bed.csv";
  p.bed.given = std::make_shared<GivenBed>(std::move(bed));
  return with_level(Layout(p)).given;
}

TEST(GivenBed, ParticlesHaveThePositionsVelocitiesAndDensitiesOfTheFile) {
  GivenBed bed = grid_of(4);
  bed.velocity.assign(16, {0.1, 0.2, -0.3});
  bed.density.assign(16, 1400);
  bed.density[3] = 1300;
  Parameters p = with_bed(bed);
  make_granular(p);
  ASSERT_THAT(check(p), IsEmpty());
  EXPECT_DOUBLE_EQ(p.bed.height, spacing);
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  ASSERT_EQ(s.position.size(), 16u);
  EXPECT_DOUBLE_EQ(s.mass, p.bed.packing * p.grains.density * spacing * spacing * spacing);
  for (std::size_t i = 0; i < 16; ++i) {
    const auto n = static_cast<std::size_t>(s.identity[i]);
    EXPECT_EQ(s.position[i], bed.position[n]);
    EXPECT_EQ(s.velocity[i], bed.velocity[n]);
    EXPECT_EQ(s.density[i], bed.density[n]) << "kept where the free surface is";
    EXPECT_EQ(s.material.stress[0][i], 0);
  }
  model.advance(team);
}

TEST(GivenBed, FaultsNameTheLine) {
  GivenBed bed = grid_of(3);
  for (int line = 2; line < 11; ++line) bed.lines.push_back(line);
  bed.position[4].z = -0.01;
  bed.density.assign(9, 1500);
  bed.density[7] = 0;
  bed.position[5].x = std::nan("");
  auto problems = check(with_bed(bed));
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].what, "bed.csv: line 6: z = -10 mm is outside the box");
  EXPECT_EQ(problems[0].allowed, "0 to 100 mm");
  EXPECT_EQ(problems[1].what, "bed.csv: line 7: position or velocity is not finite");
  EXPECT_EQ(problems[2].what, "bed.csv: line 9: density = 0 kg/m3");
  bed = grid_of(3);
  bed.position[8] = bed.position[1] + Vector3{0.1 * spacing, 0, 0};
  problems = check(with_bed(bed));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].what, "bed.csv: particle 1: is 1 mm from particle 8");
}

}  // namespace
}  // namespace talus::continuum
