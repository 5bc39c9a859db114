// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/mobility_sum.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "cases.hpp"

namespace talus::cloud {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::Not;

Parameters spectral_disc(std::int64_t count) {
  Parameters p = disc(count);
  p.fluid.sum = Sum::spectral;
  return p;
}

Parameters spectral_ball(std::int64_t count) {
  Parameters p = polystyrene(Shape::ball, count);
  p.particles.size = p.particles.radius * std::cbrt(static_cast<double>(count) / 0.1);
  p.motion = Motion::xyz;
  p.fluid.sum = Sum::spectral;
  return p;
}

TEST(MobilitySum, IsSpectralForManyGrains) {
  Parameters p = disc(100);
  EXPECT_EQ(spectral_accuracy_of(p, 2000), nullptr) << "the papers' clouds keep the direct sum";
  EXPECT_EQ(spectral_accuracy_of(p, 100000), &spectral_accuracies[0]);
  p.fluid.sum_error = 1e-7;
  EXPECT_EQ(spectral_accuracy_of(p, 100000), nullptr) << "more accurate than it is known to be";
  p.fluid.sum_error = 1e-3;
  p.motion = Motion::xyz;
  EXPECT_EQ(spectral_accuracy_of(p, 10000), nullptr) << "avalanche-3d keeps the direct sum";
  EXPECT_EQ(spectral_accuracy_of(p, 100000), &spectral_accuracies[0]);
  p.motion = Motion::xz;
  p.fluid.sum = Sum::direct;
  EXPECT_EQ(spectral_accuracy_of(p, 100000), nullptr);
  p.fluid.sum = Sum::spectral;
  EXPECT_EQ(spectral_accuracy_of(p, 10), &spectral_accuracies[0]);
}

TEST(MobilitySum, RefusesTheSpectralSumBeyondItsAccuracy) {
  Parameters p = spectral_disc(100);
  EXPECT_TRUE(check(p).empty());
  p.fluid.sum_error = 1e-6;
  EXPECT_THAT(check(p), Contains(Field(&Problem::key, "fluid.sum_error")));
  p.motion = Motion::xyz;
  EXPECT_THAT(check(p), Contains(Field(&Problem::key, "fluid.sum_error")));
  p.fluid.sum_error = 1e-5;
  EXPECT_THAT(check(p), Not(Contains(Field(&Problem::key, testing::StartsWith("fluid.")))));
}

// The steps of a run are those of the direct sum, and the stiffest rate, a difference of velocities, is the same.
TEST(MobilitySum, TakesTheStepsOfTheDirectSum) {
  ThreadTeam team(1);
  for (Parameters p : {spectral_disc(300), spectral_ball(300)}) {
    Cloud spectral = started(p, team);
    p.fluid.sum = Sum::direct;
    Cloud direct = started(p, team);
    EXPECT_GT(spectral.state().sum_cutoff, 0);
    EXPECT_EQ(direct.state().sum_cutoff, 0);
    for (int step = 0; step < 20; ++step) spectral.advance(team), direct.advance(team);
    EXPECT_NEAR(spectral.state().time, direct.state().time, 0.02 * direct.state().time);
    EXPECT_NEAR(spectral.state().spectral_radius, direct.state().spectral_radius, 0.1 * direct.state().spectral_radius);
    EXPECT_NEAR(spectral.totals().back().value, direct.totals().back().value,
                0.02 * std::abs(direct.totals().back().value));
  }
}

TEST(MobilitySum, ResumesToTheSameBits) {
  ThreadTeam one(1), three(3);
  for (const Parameters& p : {spectral_disc(300), spectral_ball(300)}) {
    Cloud through = started(p, one);
    for (int step = 0; step < 20; ++step) through.advance(one);  // sorted, and its cut-off chosen, at step 16
    Cloud resumed(p, {through.state().position, through.state().radius});
    resumed.mutable_state() = through.state();
    resumed.resume(three);
    for (int step = 0; step < 15; ++step) through.advance(one), resumed.advance(three);
    EXPECT_EQ(through.state().time, resumed.state().time);
    EXPECT_EQ(std::memcmp(through.state().position.data(), resumed.state().position.data(), 300 * sizeof(Vector3)), 0);
  }
}

TEST(MobilitySum, IsDirectWhereTheGrainsAreTooFarApartForAGrid) {
  ThreadTeam team(1);
  const Parameters p = spectral_disc(100);
  Grains grains = pack(p);
  MobilitySum sum(p, grains.radius);
  std::vector<std::uint32_t> order(100);
  for (std::uint32_t n = 0; n < 100; ++n) order[n] = n;
  sum.arrange(order, sum.choose(grains.position));
  grains.position[7] += Vector3{1e6 * p.particles.radius, 1e6 * p.particles.radius, 0};
  const std::vector<Vector3> force(100, {1e-5, 0, 0});
  std::vector<Vector3> velocity(100), direct(100);
  sum.velocities(team, grains.position, force, velocity);
  PairSum pairs({.mobility = p.fluid.mobility, .motion = p.motion, .viscosity = p.fluid.viscosity}, grains.radius,
                order);
  pairs.velocities(team, grains.position, force, direct);
  EXPECT_EQ(std::memcmp(velocity.data(), direct.data(), 100 * sizeof(Vector3)), 0);
}

}  // namespace
}  // namespace talus::cloud
