// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.hpp"

namespace talus {
namespace {

/// Points at random in a sphere of radius 1.
std::vector<Vector3> sphere(std::size_t count) {
  Random random(2);
  std::vector<Vector3> points;
  while (points.size() < count) {
    const Vector3 x{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (norm(x) <= 1) points.push_back(x);
  }
  return points;
}

const Vector3 down{0, 0, -1};

TEST(FallingCloud, OfAnEvenSphere) {
  const auto points = sphere(40000);
  const std::vector<Vector3> velocity(points.size(), Vector3{0.3, 0, -7});
  const FallingCloud cloud = measure_falling_cloud(points, velocity, down, 1);
  EXPECT_NEAR(cloud.fall_speed, 7, 1e-9);
  EXPECT_EQ(cloud.leaked_fraction, 0);
  EXPECT_NEAR(cloud.flatness, 1, 0.02);
  // Columns of height 2 sqrt(1 - r^2): 1 - (1 - r^2)^1.5 of the grains within r, so 90 % within r = 0.8857, and 0.1031
  // within 0.3 of that, against 0.9 * 0.09.
  EXPECT_NEAR(cloud.axial_density, 0.1031 / 0.081, 0.04);
}

TEST(FallingCloud, ARingHasAHole) {
  std::vector<Vector3> ring;
  for (int k = 0; k < 500; ++k) {
    const double angle = 2 * std::numbers::pi * k / 500;
    ring.push_back({std::cos(angle), std::sin(angle), 0.1 * std::sin(5 * angle)});
  }
  const FallingCloud cloud = measure_falling_cloud(ring, std::vector<Vector3>(500), down, 1);
  EXPECT_EQ(cloud.axial_density, 0);
  EXPECT_NEAR(cloud.flatness, 10, 1e-6);  // sqrt(1 / (2 * 0.1^2 / 2))
}

TEST(FallingCloud, GrainsFarBehindHaveLeaked) {
  auto points = sphere(900);
  for (int k = 0; k < 100; ++k) points.push_back({0, 0, 3.0 + 0.1 * k});  // above: behind
  std::vector<Vector3> velocity(900, Vector3{0, 0, -2});
  velocity.resize(1000);
  const FallingCloud cloud = measure_falling_cloud(points, velocity, down, 1);
  EXPECT_NEAR(cloud.leaked_fraction, 0.1, 1e-12);
  EXPECT_NEAR(cloud.fall_speed, 2, 1e-12);
}

}  // namespace
}  // namespace talus
