// SPDX-License-Identifier: Apache-2.0
#include "io/figure/figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace talus::figure {
namespace {

Domain box() {
  return Domain(
      {{0, 0, 0},
       {10, 10, 10},
       {FaceKind::wall, FaceKind::wall, FaceKind::symmetry, FaceKind::symmetry, FaceKind::wall, FaceKind::open}},
      {Wall("plate", {0, 0, 5}, {10, 0, 5}, {{4, 6}})});
}

TEST(ParticleDots, AreNormalWithinTwiceH) {
  const std::vector<Vector3> particle = {{5, 5, 2.5}};
  const double h = 1;
  const auto dots = particle_dots(particle, std::vector<double>{h}, std::vector<std::int64_t>{7}, box(), 20000);
  ASSERT_EQ(dots.size(), 20000u);
  double farthest = 0, squares = 0;
  Vector3 mean;
  for (const Vector3& x : dots) {
    const Vector3 d = x - particle[0];
    farthest = std::max(farthest, norm(d));
    squares += dot(d, d) / 20000;
    mean += (1.0 / 20000) * d;
  }
  EXPECT_LT(farthest, 2 * h);
  EXPECT_GT(farthest, 1.9 * h);
  EXPECT_NEAR(norm(mean), 0, 0.015);
  // Of a normal distribution in space cut at 3 standard deviations: 3 - 27 phi(3)/(0.5 - ...) = 2.842 variances.
  const double cut = std::erf(3 / std::sqrt(2.0)) - 2 * 3 * std::exp(-4.5) / std::sqrt(2 * M_PI);
  const double fifth = 3 * cut - 2 * 27 * std::exp(-4.5) / std::sqrt(2 * M_PI);
  EXPECT_NEAR(squares / (4.0 / 9), fifth / cut, 0.04);
}

TEST(ParticleDots, StayOnTheirSideOfWallsAndPlates) {
  const std::vector<Vector3> particles = {{0.2, 5, 0.3}, {2, 0.1, 5.2}, {8, 9, 4.9}, {5, 5, 5.1}};
  const std::vector<double> h(4, 1.0);
  const auto dots = particle_dots(particles, h, std::vector<std::int64_t>{0, 1, 2, 3}, box());
  ASSERT_EQ(dots.size(), 200u);
  for (const Vector3& x : dots) EXPECT_TRUE(x.x >= 0 && x.x <= 10 && x.y >= 0 && x.y <= 10 && x.z >= 0);
  for (std::size_t n = 50; n < 100; ++n) EXPECT_GE(dots[n].z, 5);
  for (std::size_t n = 100; n < 150; ++n) EXPECT_LE(dots[n].z, 5);
  EXPECT_TRUE(std::any_of(dots.begin() + 150, dots.end(), [](const Vector3& x) { return x.z < 5; })) << "the slit";
}

TEST(ParticleDots, FollowTheParticlesIdentity) {
  const std::vector<Vector3> particles = {{3, 5, 2.5}, {7, 5, 2.5}}, turned = {particles[1], particles[0]};
  const std::vector<double> h(2, 0.5);
  const auto one = particle_dots(particles, h, std::vector<std::int64_t>{4, 9}, box());
  const auto other = particle_dots(turned, h, std::vector<std::int64_t>{9, 4}, box());
  for (std::size_t n = 0; n < 50; ++n) EXPECT_EQ(one[n], other[50 + n]);
  EXPECT_NE(one[0].y, one[50].y);
}

}  // namespace
}  // namespace talus::figure
