// SPDX-License-Identifier: Apache-2.0
/// Beds of a given mass, grains that come in, grains that are taken away.
#include "models/continuum/population.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "models/continuum/cases.hpp"
#include "models/continuum/level_cases.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

Parameters silo_that_rubs() {
  Parameters p = shut_silo();
  p.walls.friction_from = FrictionFrom::start;
  return p;
}

double mass_of(const State& s) {
  return s.mass * double(s.position.size());
}

/// Momentum that is not accounted for.
Vector3 unexplained(const State& s) {
  return momentum_error(s) - s.population.fed_momentum + s.population.removed_momentum;
}

TEST(Filling, AMassFillsTheVesselFromBelow) {
  Parameters p = silo_that_rubs();
  const double whole = mass_of(Continuum(p).state());
  for (const double share : {1.0, 0.37}) {
    Parameters by_mass = p;
    by_mass.bed.height = 0;
    by_mass.bed.mass = share * whole;
    ASSERT_THAT(check(by_mass), testing::IsEmpty());
    const Parameters filled = with_level(Layout(by_mass)).given;
    const State s = Continuum(filled).state();
    EXPECT_NEAR(mass_of(s), share * whole, 0.5001 * s.mass);
    double top = 0;
    for (const Vector3& x : s.position) top = std::max(top, x.z);
    EXPECT_LT(top, 6 * spacing + filled.bed.height);
    EXPECT_GT(top, 6 * spacing + filled.bed.height - 1.5 * spacing) << "no higher than it needs";
    if (share == 1) {
      EXPECT_NEAR(filled.bed.height, p.bed.height, 1e-12);
      EXPECT_EQ(s.position, Continuum(p).state().position);
    }
  }
}

TEST(Filling, AQuarterIsFilledInsideWhereverTheBoxEnds) {
  for (const double side : {11, 14, 16}) {  // spacings; the middle of the box within the cylinder, at it and beyond
    Parameters p = column(side, side, 6, 4);
    p.box.left = p.box.front = FaceKind::symmetry;
    VesselPart wall;
    wall.shape = VesselShape::cylinder, wall.radius = 10 * spacing, wall.top = 9 * spacing, wall.centre = {0, 0};
    p.vessel = {wall};
    const State s = Continuum(p).state();
    EXPECT_NEAR(static_cast<double>(s.position.size()), 6 * 25 * half_turn, 12) << side;
    for (const Vector3& x : s.position) ASSERT_LT(std::hypot(x.x, x.y), 10 * spacing) << side;
  }
}

TEST(Filling, AMassThatDoesNotFitIsRefusedWithTheLargestThatDoes) {
  Parameters p = silo_that_rubs();
  p.bed.height = 0;
  p.bed.mass = 100;
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "bed.mass");
  p.bed.mass = 1e-6;
  EXPECT_EQ(check(p).size(), 1u);
}

TEST(Removal, WhatFallsOutIsTakenAwayAndCounted) {
  Parameters p = silo_that_rubs();
  p.removal.below = 2 * spacing;
  p.bed.height = 6 * spacing;
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const std::size_t count = s.position.size();
  std::uint64_t before = 0;
  while (s.time < 0.35) {
    model.advance(team);
    EXPECT_EQ(s.position.size() + s.population.removed, count) << "none is lost";
    EXPECT_GE(s.population.removed, before);
    before = s.population.removed;
  }
  EXPECT_GT(s.population.removed, count / 2);
  const std::set<std::int64_t> numbers(s.identity.begin(), s.identity.end());
  EXPECT_EQ(numbers.size(), s.position.size()) << "each is itself";
  EXPECT_LT(norm(unexplained(s)), 1e-11 * norm(s.gravity_impulse));
  while (s.time < 1.5) model.advance(team);
  EXPECT_TRUE(s.position.empty());
  EXPECT_EQ(s.population.removed, count);
  EXPECT_LT(norm(unexplained(s)), 1e-11 * norm(s.gravity_impulse));
}

TEST(Removal, BeyondOpenFaces) {
  Parameters p = free_block(3, 3, 3);
  p.box.depth = 20 * spacing;
  p.removal.outside = true;
  p.bed.bottom = 3 * spacing;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const std::size_t count = s.position.size();
  while (s.time < 0.12) model.advance(team);
  double lowest = 1;
  for (const Vector3& x : s.position) lowest = std::min(lowest, x.z);
  EXPECT_EQ(s.position.size() + s.population.removed, count);
  EXPECT_GT(s.population.removed, 0u);
  EXPECT_GT(lowest, -3 * spacing) << "but for a step";
}

/// Grains come down through a window over a bed of one layer.
Parameters rain() {
  Parameters p = column(8, 8, 2, 30);
  make_granular(p);
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  Inlet inlet;
  inlet.centre = {4 * spacing, 4 * spacing, 25 * spacing};
  inlet.width = 4 * spacing, inlet.depth = 3 * spacing;
  inlet.velocity = {0.1, 0, -1};
  inlet.rate = 12 * lattice_of(p).mass / 0.02;  // a layer of twelve every 20 ms
  inlet.from = 5e-3;
  inlet.to = 0.1;
  p.inlets = {inlet};
  return p;
}

TEST(Inlets, ParticlesComeInAsTheRateSays) {
  const Parameters p = rain();
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const std::size_t bed = s.position.size();
  while (s.time < 0.2) {
    model.advance(team);
    const double layers = s.time < 0.015 ? 0 : std::floor((std::min(s.time, 0.1) - 0.015) / 0.02) + 1;
    ASSERT_EQ(s.population.fed, 12 * static_cast<std::uint64_t>(layers)) << s.time;
    ASSERT_EQ(s.position.size(), bed + s.population.fed);
  }
  EXPECT_EQ(s.population.fed, 60u) << "12 every 20 ms from 5 to 100 ms, to the nearest layer";
  EXPECT_NEAR(s.population.fed_momentum.z, -60 * s.mass, 1e-9 * s.mass);
  EXPECT_LT(norm(unexplained(s)), 1e-11 * norm(s.gravity_impulse));
}

class FirstLayer : public testing::TestWithParam<std::optional<double>> {};
INSTANTIATE_TEST_SUITE_P(DampingTime, FirstLayer, testing::Values(std::nullopt, std::optional(5e-3)));

TEST_P(FirstLayer, FallsFreelyWhileTheVesselIsFilled) {
  Parameters p = rain();
  p.gate = {.opens = GateOpens::at_time, .time = 1};
  p.settle.damping_time = GetParam();
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto first = static_cast<std::int64_t>(s.position.size());
  while (s.time < 0.06) model.advance(team);
  const double t = s.time - 0.015;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (s.identity[i] < first || s.identity[i] >= first + 12) continue;
    EXPECT_NEAR(s.position[i].z, 25 * spacing - t - 0.5 * 9.81 * t * t, 0.01 * spacing)
        << "but for g dt t, since its speed is that of half a step before";
    EXPECT_NEAR(s.velocity[i].x, 0.1, 1e-12) << "nothing pushes them apart";
    ++seen;
  }
  EXPECT_EQ(seen, 12u);
}

TEST(Inlets, ALayerWaitsUntilThereIsRoom) {
  Parameters p = rain();
  p.inlets[0].centre[2] = 3.2 * spacing;
  p.inlets[0].velocity = {0, 0, -0.6};
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const std::size_t bed = s.position.size();
  while (s.time < 0.15) model.advance(team);
  EXPECT_GT(s.population.fed, 0u);
  EXPECT_LT(s.population.fed, 60u) << "the heap reaches the window";
  EXPECT_EQ(s.position.size(), bed + s.population.fed);
}

TEST(Inlets, ALayerFindsNoRoomBetweenCoarserParticles) {
  Parameters p = bed_of_levels(1);
  p.levels.high = {spacing, spacing, spacing};
  Inlet inlet;
  inlet.centre = {0.75 * p.box.width, 0.5 * p.box.depth, 9.5 * spacing};
  inlet.width = 4 * spacing, inlet.depth = 4 * spacing;
  inlet.velocity = {0, 0, -1};
  inlet.rate = 16 * lattice_of(p).mass / 0.02;
  inlet.to = 1;
  p.inlets = {inlet};
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.time < 0.05) model.advance(team);
  EXPECT_EQ(s.population.fed, 0u);
}

TEST(Inlets, TheBitsDependNeitherOnThreadsNorOnResuming) {
  Parameters p = rain();
  p.removal.below = 0.8 * spacing;  // the floor's layer goes as it is pressed down
  ThreadTeam one(1), two(2);
  Continuum model = started(p, one), other = started(p, two);
  const auto same = [](const State& a, const State& b) {
    return a.time == b.time && a.position == b.position && a.velocity == b.velocity && a.density == b.density &&
           a.material.stress == b.material.stress && a.identity == b.identity;
  };
  while (model.state().time < 0.05) model.advance(one), other.advance(two);
  ASSERT_TRUE(same(model.state(), other.state()));
  Continuum resumed(p);
  resumed.mutable_state() = model.state();
  resumed.resume(two);
  while (model.state().time < 0.12) model.advance(one), resumed.advance(two);
  EXPECT_TRUE(same(model.state(), resumed.state()));
  EXPECT_EQ(model.state().population.fed, resumed.state().population.fed);
  EXPECT_GT(resumed.state().population.removed, 0u);
}

TEST(Inlets, ThoseBesideTheVesselAreTold) {
  Parameters p = silo_that_rubs();
  p.box.floor = FaceKind::open;
  Inlet within;
  within.centre = {0.5 * p.box.width, 0.5 * p.box.depth, 0.9 * p.box.height}, within.velocity = {0, 0, -1};
  within.width = within.depth = 2 * p.bed.spacing, within.rate = 0.01;
  Inlet beside = within, thrown = within;
  beside.centre[0] = p.bed.spacing;
  thrown.velocity = {5, 0, -0.1};
  p.inlets = {within, beside, thrown};
  EXPECT_THAT(inlets_past_vessel(Layout(p)), testing::ElementsAre(1, 2));
  p.box.floor = FaceKind::wall;
  EXPECT_THAT(inlets_past_vessel(Layout(p)), testing::IsEmpty());
}

/// The nearest two places of a layer, m.
double least_distance(const InletLayer& layer) {
  double least = 1;
  for (std::size_t i = 0; i < layer.places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, norm(layer.places[i] - layer.places[j]));
  return least;
}

class OverAFace : public testing::TestWithParam<FaceKind> {};
INSTANTIATE_TEST_SUITE_P(Faces, OverAFace, testing::Values(FaceKind::wall, FaceKind::symmetry));

TEST_P(OverAFace, AWindowIsWhatLiesInside) {
  Parameters p = rain();
  p.box.left = p.box.right = p.box.front = GetParam();
  Inlet& inlet = p.inlets[0];
  inlet.rate *= 0.5;
  const auto expect = [&](double x, double width, std::size_t columns, std::size_t rows) {
    inlet.centre[0] = x * spacing, inlet.width = width * spacing;
    ASSERT_THAT(check(p), testing::IsEmpty()) << x;
    const InletLayer layer = layer_of(Layout(p), inlet);
    ASSERT_EQ(layer.places.size(), columns * rows) << x;
    EXPECT_GE(least_distance(layer), spacing * (1 - 1e-9));
    for (const Vector3& place : layer.places) {
      EXPECT_GE(place.x, 0.25 * spacing * (1 - 1e-9));
      EXPECT_LE(place.x, p.box.width - 0.25 * spacing * (1 - 1e-9));
    }
    EXPECT_NEAR(double(layer.places.size()) * lattice_of(p).mass / layer.interval, inlet.rate, 1e-9 * inlet.rate);
    EXPECT_EQ(cut_window(Layout(p), inlet).has_value(), columns < std::size_t(width));
  };
  expect(2, 4, 4, 3);
  expect(1.3, 4, 3, 3);
  expect(0, 4, 2, 3);
  expect(8, 4, 2, 3);
  expect(3, 20, 8, 3);
  inlet.shape = InletShape::disc, inlet.radius = 3 * spacing, inlet.centre = {0, 0, 25 * spacing};
  const InletLayer quarter = layer_of(Layout(p), inlet);
  EXPECT_EQ(quarter.places.size(), 8u) << "three by three places but the outermost";
  EXPECT_GE(least_distance(quarter), spacing * (1 - 1e-9));
}

TEST_P(OverAFace, GrainsFallFreely) {
  Parameters p = rain();
  p.box.left = GetParam();
  p.inlets[0].centre[0] = 0.75 * spacing;
  p.inlets[0].velocity = {0, 0, -1}, p.inlets[0].rate *= 0.5;
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.time < 0.12) {
    model.advance(team);
    for (const Vector3& v : s.velocity) ASSERT_LT(norm(v), 1.05 * std::sqrt(1 + 2 * 9.81 * 25 * spacing)) << s.time;
  }
  EXPECT_GT(s.population.fed, 0u);
}

TEST(Inlets, NoRoomBesideAFaceIsTold) {
  Parameters p = rain();
  p.box.left = FaceKind::wall;
  p.inlets[0].centre[0] = 0.1 * spacing, p.inlets[0].width = 0.4 * spacing;
  ASSERT_EQ(check(p).size(), 1u);
  EXPECT_EQ(check(p)[0].key, "inlet.1.centre");
  p.inlets[0].width = 4 * spacing, p.inlets[0].rate *= 1.5;  // as fits, but half of the window is left
  ASSERT_EQ(check(p).size(), 1u);
  EXPECT_EQ(check(p)[0].key, "inlet.1.rate");
  EXPECT_THAT(check(p)[0].what, testing::HasSubstr("what faces of the box leave of the window"));
}

TEST(Inlets, AWindowAcrossAPeriodicBoxMeetsNotItself) {
  Parameters p = rain();
  p.box.left = p.box.right = FaceKind::periodic;
  p.box.width = 8.5 * spacing, p.inlets[0].width = 20 * spacing;
  EXPECT_EQ(layer_of(Layout(p), p.inlets[0]).places.size(), 8u * 3u);
}

TEST(Inlets, ContradictionsAreToldAllAtOnce) {
  Parameters p = rain();
  p.inlets.push_back(p.inlets[0]);
  p.inlets[0].rate *= 100;
  p.inlets[1].velocity = {0, 0, 1};
  p.inlets[1].to = 1e-3;
  std::vector<std::string> keys;
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  EXPECT_THAT(keys, testing::UnorderedElementsAre("inlet.1.rate", "inlet.2.velocity", "inlet.2.to"));
}

}  // namespace
}  // namespace talus::continuum
