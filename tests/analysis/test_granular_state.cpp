// SPDX-License-Identifier: Apache-2.0
#include "analysis/granular_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "analysis/particle_field.hpp"
#include "analysis/particles.hpp"

namespace talus {
namespace {

TEST(InertialNumber, OfAState) {
  EXPECT_DOUBLE_EQ(inertial_number(10, 2500, 200e-6, 2500), 2e-3);
  EXPECT_EQ(inertial_number(0, 0, 1, 1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(inertial_number(1, -3, 1, 1), std::numeric_limits<double>::infinity());
}

/// Particles one above the other: two at rest under stress, one in shear, one free.
test::GrainColumns four() {
  test::GrainColumns c({{0, 0, 0.05}, {0, 0, 0.15}, {0, 0, 0.16}, {0, 0, 0.17}}, 1500, 2500);
  c.stress_xx = {60, 140, 1000, 0};
  c.stress_yy = {60, 140, 1000, 0};
  c.stress_zz = {100, 200, 1000, 0};
  c.shear_rate = {0, 0, 100, 0};
  return c;
}

TEST(StressRatio, IsWeightedWithTheVerticalStressOfQuasistaticGrains) {
  test::GrainColumns c = four();
  const auto inertial = inertial_numbers(c.view(), 200e-6, 2500);
  EXPECT_DOUBLE_EQ(inertial[2], 100 * 200e-6 * std::sqrt(2500.0 / 1000));
  const auto ratio = [&] { return stress_ratio(c.view(), quasistatic_particles(c.view(), inertial)); };
  EXPECT_DOUBLE_EQ(ratio(), 200.0 / 300);
  c.packing[0] = 0.5;
  EXPECT_DOUBLE_EQ(ratio(), 0.7);
  c.packing.assign(4, 0.5);
  EXPECT_TRUE(std::isnan(ratio()));
}

TEST(InertialShare, CountsGrainsWithoutStressAsFast) {
  const auto inertial = inertial_numbers(four().view(), 200e-6, 2500);
  EXPECT_DOUBLE_EQ(inertial_share(inertial, {false, true, true, true}), 1.0 / 3);
  EXPECT_DOUBLE_EQ(inertial_share(inertial, {true, true, true, true}), 0.5);
  EXPECT_TRUE(std::isnan(inertial_share(inertial, {false, false, false, false})));
}

TEST(VelocityGradientSizes, OfSimpleShearAndCompression) {
  constexpr double h = 1e-2;
  const auto points = test::lattice(0.1, 0.05, 0, 0.1, h);
  const Domain domain(
      {{-1, -1, -1},
       {1, 1, 1},
       {FaceKind::open, FaceKind::open, FaceKind::open, FaceKind::open, FaceKind::open, FaceKind::open}});
  std::vector<Vector3> velocity;
  for (const Vector3& x : points) velocity.push_back({7 * x.z - x.x, 0, 0});
  std::vector<double> packing(points.size(), 0.6);
  const ParticleField field(test::particles(points, h), domain);
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  const auto gradients = velocity_gradients(field.particles(), field.domain(), all, velocity);
  const GradientSizes sizes = velocity_gradient_sizes(gradients, packing, 200e-6, 9.8);
  const double unit = std::sqrt(200e-6 / 9.8);
  EXPECT_NEAR(sizes.shear_max, 7 * unit, 1e-12);
  EXPECT_NEAR(sizes.normal_max, 1 * unit, 1e-12);
  packing.assign(points.size(), 0.4);
  EXPECT_TRUE(std::isnan(velocity_gradient_sizes(gradients, packing, 200e-6, 9.8).shear_max));
}

TEST(DensityDrift, IsTheMeanOverThoseTaken) {
  const std::vector<double> density = {1500, 1530, 1000}, packing = {0.6, 0.6, 0.6};
  EXPECT_NEAR(density_drift(density, packing, 2500, {true, true, false}), 0.01, 1e-15);
  EXPECT_TRUE(std::isnan(density_drift(density, packing, 2500, {false, false, false})));
  EXPECT_EQ(quantile_of(density, {true, false, true}, 0), 1000);
}

TEST(MeanSpeeds, FollowGrainsByTheirIdentity) {
  test::GrainColumns before({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1500, 2500, 0.98);
  test::GrainColumns now({{2, 0, 0.04}, {0, 0, 0.02}, {5, 5, 5}}, 1500, 2500, 1.0);
  now.identity = {2, 0, 7};
  const Domain space({.low = {0, 0, 0}, .high = {9, 9, 9}, .faces = {}});
  const auto speed = mean_speeds(before.view(), now.view(), space);
  EXPECT_NEAR(speed[0], 2, 1e-12);
  EXPECT_NEAR(speed[1], 1, 1e-12);
  EXPECT_TRUE(std::isnan(speed[2]));
  EXPECT_THROW(mean_speeds(now.view(), before.view(), space), std::invalid_argument);
}

TEST(MeanSpeeds, ThroughAPeriodicFaceOrASideOfASectorAreThoseOfTheShorterWay) {
  using enum FaceKind;
  test::GrainColumns before({{8.9, 0, 0}, {1, 0, 0}}, 1500, 2500, 0);
  test::GrainColumns now({{0.1, 0, 0}, {1, 0.1, 0}}, 1500, 2500, 1);
  const Domain ring({.low = {0, 0, 0}, .high = {9, 9, 9}, .faces = {periodic, periodic, open, open, open, open}});
  EXPECT_NEAR(mean_speeds(before.view(), now.view(), ring)[0], 0.2, 1e-12);
  EXPECT_NEAR(mean_speeds(before.view(), now.view(), ring)[1], 0.1, 1e-12);
  test::GrainColumns side({{2, 0.05, 0}}, 1500, 2500, 0), other({{-0.05, 2, 0}}, 1500, 2500, 1);
  const Domain quarter({.low = {-9, -9, 0}, .high = {9, 9, 9}, .faces = {open, open, open, open, open, open}}, {}, 0,
                       Sector({0, 0, 0}, 4));
  EXPECT_NEAR(mean_speeds(side.view(), other.view(), quarter)[0], 0, 1e-12) << "turned by the sector's angle";
}

}  // namespace
}  // namespace talus
