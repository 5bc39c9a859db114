// SPDX-License-Identifier: Apache-2.0
/// Runs without any particle, and with several beds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <map>
#include <string>

#include "models/continuum/bed_cases.hpp"
#include "models/continuum/population.hpp"
#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A bin that is filled from above and drains, once or twice. Nothing is there at the start.
Parameters empty_bin() {
  Parameters p = room(12, 12, 30);
  make_granular(p);
  p.bed.height = 0;
  p.vessel = {tube("bin", 6, 6, 4, 10, 28), gate_at(6, 6, 4, 10)};
  p.gate.opens = GateOpens::at_time, p.gate.time = 0.08;
  p.integration.method = Method::leapfrog, p.integration.courant = 0.6;
  Inlet inlet;
  inlet.centre = {6 * spacing, 6 * spacing, 12 * spacing};
  inlet.width = inlet.depth = 3 * spacing;
  inlet.velocity = {0, 0, -1};
  inlet.rate = 9 * lattice_of(p).mass / 0.02;
  inlet.from = 0.02, inlet.to = 0.05;
  p.inlets = {inlet};
  p.removal.below = 6 * spacing;
  return p;
}

/// A quarter of an upright box, of 10.4 by 10.4 spacings, its axis along the corner of the box between two planes of
/// symmetry.
TEST(Bed, OfAQuarterOfABoxEndsAtItsWalls) {
  Parameters p = room(16, 16, 30);
  make_granular(p);
  p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::symmetry;
  VesselPart bin = named("bin", VesselShape::box);
  bin.centre = {0, 0}, bin.width = bin.depth = 20.8 * spacing, bin.bottom = 0, bin.top = 20 * spacing;
  p.vessel = {bin};
  p.bed.height = 8 * spacing;
  ASSERT_THAT(check(p), IsEmpty());
  const Layout layout(p);
  const double expected = bulk_density(p) * 10.4 * 10.4 * 8 * spacing * spacing * spacing;
  EXPECT_NEAR(layout.lattice.mass * bed_count(layout), expected, 1e-9 * expected);
  for (const Vector3& x : bed_positions(layout)) EXPECT_LT(std::max(x.x, x.y), 10.4 * spacing);
}

TEST(NoParticles, ABinIsFilledFromAnInletAndDrainsToTheLast) {
  const Parameters p = empty_bin();
  ASSERT_THAT(check(p), IsEmpty());
  EXPECT_EQ(bed_count(Layout(p)), 0);
  EXPECT_DOUBLE_EQ(depth_of_grains(p), 18 * spacing) << "what an inlet can fill";
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  EXPECT_EQ(model.snapshot().size(), 0u);
  EXPECT_FALSE(model.ended()) << "grains are to come";
  double longest = 0;
  while (s.time < 2 && !model.ended()) {
    model.advance(team);
    longest = std::max(longest, s.last_step);
    for (const NamedValue& total : model.totals()) EXPECT_FALSE(std::isinf(total.value)) << total.name;
  }
  EXPECT_LT(longest, 1e-2);
  EXPECT_EQ(s.population.fed, 18u);
  EXPECT_EQ(s.population.removed, 18u);
  EXPECT_TRUE(s.position.empty());
  ASSERT_TRUE(model.ended());
  EXPECT_THAT(*model.ended(), HasSubstr("has emptied"));
  EXPECT_LT(norm(momentum_error(s) - s.population.fed_momentum + s.population.removed_momentum),
            1e-11 * norm(s.gravity_impulse));
  EXPECT_NO_THROW(model.step_limit());
  EXPECT_NO_THROW(model.regime({}));
  model.advance(team);
}

TEST(NoParticles, AnEmptyVesselWaitsForItsInletAndGoesOnWithTheSameBits) {
  Parameters p = empty_bin();
  Inlet later = p.inlets[0];
  later.clock = InletClock::gate, later.from = 0.4, later.to = 0.43;
  p.inlets.push_back(later);
  p.gate.time = 0.06;
  ASSERT_THAT(check(p), IsEmpty());
  ThreadTeam one(1), two(2);
  Continuum model = started(p, one);
  const State& s = model.state();
  // From checkpoints before the first grain, while it is empty, and of the second filling.
  for (const double at : {0.01, 0.44, 0.48}) {
    while (s.time < at) model.advance(one);
    EXPECT_EQ(s.position.empty(), at < 0.48) << at;
    std::map<std::string, std::any> kept;  // as a checkpoint keeps them
    const auto keep = [&](const FieldInfo& field, const auto& member) {
      if (field.role == FieldRole::kept) kept[std::string(field.name)] = member;
    };
    for_each_field(keep, s);
    Continuum resumed(p);
    const auto take = [&]<class Member>(const FieldInfo& field, Member& member) {
      if (field.role == FieldRole::kept) member = std::any_cast<Member>(kept.at(std::string(field.name)));
    };
    for_each_field(take, resumed.mutable_state());
    resumed.resume(two);
    Continuum straight(p);
    straight.mutable_state() = s;
    straight.resume(one);
    for (int step = 0; step < 300; ++step) straight.advance(one), resumed.advance(two);
    const State &a = straight.state(), &b = resumed.state();
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.population.fed, b.population.fed);
    EXPECT_TRUE(a.position == b.position && a.velocity == b.velocity && a.density == b.density &&
                a.material.stress == b.material.stress && a.lasting_rate == b.lasting_rate)
        << at;
    EXPECT_EQ(a.lasting_rate[0].size(), a.position.size()) << "the columns of the case are there again";
  }
}

TEST(NoParticles, WithoutAnInletABedIsMissing) {
  Parameters p = empty_bin();
  EXPECT_TRUE(beds_of(p).empty());
  p.bed.mass = 10 * lattice_of(p).mass;
  EXPECT_FALSE(beds_of(p).empty());
}

/// Of a drained sector as of a whole vessel.
TEST(NoParticles, ADrainedSectorHasItsColumns) {
  Parameters p = empty_bin();
  p.inlets.clear();
  p.bed.height = 3 * spacing;
  p.box.sector = 30 * M_PI / 180;
  p.gate.opens = GateOpens::from_the_start;
  ASSERT_THAT(check(p), IsEmpty());
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const std::size_t columns = model.snapshot().columns.size();
  while (model.state().time < 1 && !model.ended()) model.advance(team);
  ASSERT_TRUE(model.ended());
  EXPECT_EQ(model.snapshot().size(), 0u);
  EXPECT_EQ(model.snapshot().columns.size(), columns);
}

/// Three layers, the uppermost half as wide, of the same grains.
Parameters layers() {
  Parameters p = column(8, 4, 3, 9);
  TaggedBed second, third;
  second.bottom = 3 * spacing, second.height = 2 * spacing, second.tag = 7;
  third.bottom = 5 * spacing, third.height = 4 * spacing, third.right = 4 * spacing, third.tag = 2;
  third.velocity = {0, 0, -0.1};
  p.beds = {second, third};
  return p;
}

TEST(Beds, AreAsDeepAsTheyAreWithoutTheAirBetweenThem) {
  Parameters p = layers();
  p.beds[1].bottom = 8 * spacing, p.beds[1].height = spacing;
  EXPECT_NEAR(depth_of_grains(p), 6 * spacing, 1e-12);
  const std::vector<Extent> heights = heights_of_beds(p);
  ASSERT_EQ(heights.size(), 2u);
  EXPECT_NEAR(heights[0].high, 5 * spacing, 1e-12);
  EXPECT_NEAR(heights[1].low, 8 * spacing, 1e-12);
}

TEST(Beds, HaveTheirTagsAndVelocities) {
  const Parameters p = layers();
  ASSERT_THAT(check(p), IsEmpty());
  EXPECT_EQ(bed_count(Layout(p)), 8 * 4 * 5 + 4 * 4 * 4);
  EXPECT_NEAR(depth_of_grains(p), 9 * spacing, 1e-12);
  const State s = initial_state(setup_of(p));
  ASSERT_EQ(s.position.size(), 8u * 4 * 5 + 4 * 4 * 4);
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const double z = s.position[i].z / spacing;
    EXPECT_EQ(s.tag[i], z < 3 ? 0 : z < 5 ? 7 : 2);
    EXPECT_EQ(s.velocity[i].z, z < 5 ? 0 : -0.1);
  }
  EXPECT_NEAR(s.mass, 0.6 * p.grains.density * spacing * spacing * spacing, 1e-15);
}

TEST(Beds, TagsStayWithTheirGrainsAndThoseOfInletsHaveNone) {
  Parameters p = layers();
  make_granular(p);
  p.removal.below = 0.8 * spacing;
  Inlet inlet;
  inlet.centre = {6 * spacing, 2 * spacing, 10 * spacing};
  inlet.width = inlet.depth = 2 * spacing;
  inlet.velocity = {0, 0, -1};
  inlet.rate = 4 * lattice_of(p).mass / 0.01;
  p.inlets = {inlet};
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  std::map<std::int64_t, std::int64_t> tags;
  for (std::size_t i = 0; i < s.position.size(); ++i) tags[s.identity[i]] = s.tag[i];
  while (s.time < 0.03) model.advance(team);
  EXPECT_GT(s.population.fed, 0u);
  EXPECT_GT(s.population.removed, 0u);
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const auto then = tags.find(s.identity[i]);
    EXPECT_EQ(s.tag[i], then == tags.end() ? -1 : then->second);
  }
  const Snapshot snapshot = model.snapshot();
  EXPECT_TRUE(snapshot.has("tag"));
  EXPECT_FALSE(Continuum(column(2, 2, 2)).state().has.tag) << "one bed needs none";
}

TEST(Beds, FaultsNameTheBed) {
  const auto told = [](const Parameters& p) {
    std::vector<std::string> all;
    for (const Problem& problem : check(p)) all.push_back(problem.key + ": " + problem.what);
    return all;
  };
  Parameters p = layers();
  p.beds[1].bottom = 4 * spacing;
  EXPECT_THAT(told(p), testing::ElementsAre(testing::StartsWith("beds.2.bottom: [[beds]] 2 overlaps [[beds]] 1 at (")));
  p = layers();
  p.beds[0].height = 1.9 * spacing;
  EXPECT_THAT(told(p), testing::ElementsAre("beds.1.height: particles of [[beds]] 1 would have 0.95 times the mass of "
                                            "those of [bed]"));
  p = layers();
  p.beds[1].left = 5 * spacing;
  EXPECT_THAT(told(p), testing::ElementsAre(testing::AllOf(testing::StartsWith("beds.2.right: leaves no bed"),
                                                           HasSubstr("50 mm (beds.2.left) to 40 mm (beds.2.right)"))));
  p = layers();
  p.beds[1].mass = 1;
  EXPECT_THAT(told(with_level(Layout(p)).given),
              testing::ElementsAre(testing::StartsWith("beds.2.mass: 1 kg is more")));
}

/// Two silos, a bed in each, of which one is given by its mass.
TEST(Beds, LieInVesselsOfTheirOwn) {
  Parameters p = beside_a_silo();
  p.vessel[2] = tube("other", 40, 10, 4, 20, 45);
  p.vessel.push_back(gate_at(40, 10, 4, 20));
  p.vessel.back().name = "gate_2";
  TaggedBed second;
  p.bed.inside = {10 * spacing, 10 * spacing, 25 * spacing};
  second.bottom = 20 * spacing;
  second.inside = {40 * spacing, 10 * spacing, 25 * spacing};
  second.mass = 300 * lattice_of(p).mass;
  p.beds = {second};
  p = with_level(Layout(p)).given;
  ASSERT_THAT(check(p), IsEmpty());
  const State s = initial_state(setup_of(p));
  EXPECT_EQ(std::count(s.tag.begin(), s.tag.end(), 1), 300);
  EXPECT_EQ(count_within(s.position, 40, 10, 4), 300u);
  EXPECT_THAT(warnings(p), IsEmpty());
}

}  // namespace
}  // namespace talus::continuum
