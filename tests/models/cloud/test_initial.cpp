// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases.hpp"

namespace talus::cloud {
namespace {

double min_gap(const Grains& grains) {
  double gap = 1e300;
  for (std::size_t i = 0; i < grains.radius.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      gap = std::min(gap, norm(grains.position[i] - grains.position[j]) - grains.radius[i] - grains.radius[j]);
  return gap;
}

TEST(Pack, FillsTheDiscWithoutOverlap) {
  const Parameters p = disc(600);
  const Grains grains = pack(p);
  ASSERT_EQ(grains.position.size(), 600u);
  EXPECT_GE(min_gap(grains), 0);
  double furthest = 0;
  int quadrant[4] = {};
  for (const Vector3& x : grains.position) {
    EXPECT_EQ(x.z, 0);
    furthest = std::max(furthest, norm(x));
    ++quadrant[(x.x > 0) + 2 * (x.y > 0)];
  }
  EXPECT_LE(furthest, *p.particles.size);
  EXPECT_GT(furthest, 0.97 * *p.particles.size);
  for (const int count : quadrant) EXPECT_NEAR(count, 150, 40);
  EXPECT_NEAR(scales(p).volume_fraction, 0.43, 0.43 * 0.002);
}

TEST(Pack, RadiiFollowTheirDistribution) {
  Parameters p = disc(4000);
  *p.particles.size *= 3;
  auto moments = [&] {
    const Grains grains = pack(p);
    double mean = 0, square = 0, low = 1, high = 0;
    for (const double a : grains.radius) {
      mean += a / 4000, square += a * a / 4000;
      low = std::min(low, a), high = std::max(high, a);
    }
    return std::array{mean / 5e-3, std::sqrt(square - mean * mean) / 5e-3, low / 5e-3, high / 5e-3};
  };
  const auto uniform = moments();
  EXPECT_NEAR(uniform[0], 1, 0.002);
  EXPECT_NEAR(uniform[1], 0.05 / std::sqrt(3), 0.001);
  EXPECT_GE(uniform[2], 0.95);
  EXPECT_LE(uniform[3], 1.05);
  p.particles.radius_distribution = RadiusDistribution::normal;
  const auto normal = moments();
  EXPECT_NEAR(normal[1], 0.05, 0.002);
  EXPECT_GE(normal[2], 0.85);
  EXPECT_LE(normal[3], 1.15);
}

TEST(Pack, KeepsEveryGrainAboveTheSlope) {
  Parameters p = polystyrene(Shape::triangle, 500);
  p.particles.size = 60 * p.particles.radius;
  p.motion = Motion::xz;
  const Grains triangle = pack(p);
  EXPECT_GE(min_gap(triangle), 0);
  for (std::size_t i = 0; i < triangle.radius.size(); ++i) {
    EXPECT_GE(triangle.position[i].z, triangle.radius[i]);
    EXPECT_LE(std::abs(triangle.position[i].x) + triangle.position[i].z, p.particles.size);
    EXPECT_EQ(triangle.position[i].y, 0);
  }
  Parameters q = polystyrene(Shape::dome, 200);
  q.particles.size = 12 * q.particles.radius;
  q.motion = Motion::xyz;
  const Grains dome = pack(q);
  EXPECT_GE(min_gap(dome), 0);
  for (std::size_t i = 0; i < dome.radius.size(); ++i) EXPECT_GE(dome.position[i].z, dome.radius[i]);
}

TEST(Pack, AWedgeIsUprightAtItsGateAndLevelAtItsSurface) {
  Parameters p = polystyrene(Shape::wedge, 800);
  p.particles.size = 75 * p.particles.radius;
  p.motion = Motion::xz;
  p.slope.angle = 0.5;
  EXPECT_NEAR(scales(p).volume_fraction, 800 * std::numbers::pi * std::sin(1.0) / (75 * 75.0), 1e-3);
  const Grains wedge = pack(p);
  EXPECT_GE(min_gap(wedge), 0);
  double front = -1, highest = 0;
  for (const Vector3& x : wedge.position) {
    const double above_the_foot = x.z * std::cos(0.5) - x.x * std::sin(0.5);
    front = std::max(front, x.x);
    highest = std::max(highest, above_the_foot);
    EXPECT_LE(x.x, 0);
    EXPECT_LE(above_the_foot, *p.particles.size);
  }
  EXPECT_GT(front, -2 * p.particles.radius);
  EXPECT_GT(highest, *p.particles.size - 2 * p.particles.radius);
}

TEST(Pack, WholeGrainsStayInsideWhenAsked) {
  Parameters p = disc(300);
  p.particles.boundary = Boundary::whole;
  const Grains grains = pack(p);
  for (std::size_t i = 0; i < grains.radius.size(); ++i)
    EXPECT_LE(norm(grains.position[i]) + grains.radius[i], *p.particles.size * (1 + 1e-12));
}

TEST(Pack, SameSeedSamePlacesAndAnotherSeedOthers) {
  const Grains a = pack(disc(50, 3)), b = pack(disc(50, 3)), c = pack(disc(50, 4));
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_NE(a.position, c.position);
}

TEST(Pack, GivesUpOnAShapeThatIsTooSmall) {
  Parameters p = disc(200);
  *p.particles.size *= 0.8;
  EXPECT_THROW(pack(p), NumericalError);
}

TEST(Check, FindsContradictions) {
  EXPECT_TRUE(check(disc(100)).empty());
  auto keys = [](const Parameters& p) {
    std::vector<std::string> found;
    for (const Problem& problem : check(p)) found.push_back(problem.key);
    return found;
  };
  Parameters p = disc(100);
  p.particles.size.reset();
  p.motion = Motion::xyz;
  p.particles.width = 1;
  p.particles.density = 1.2;
  EXPECT_EQ(keys(p), (std::vector<std::string>{"particles.size", "particles.width", "motion", "particles.density"}));
  p = disc(100);
  *p.particles.size *= 0.85;
  EXPECT_EQ(keys(p), std::vector<std::string>{"particles.count"});
  p = disc(100);
  p.slope.angle = 0;
  EXPECT_EQ(keys(p), std::vector<std::string>{"slope.angle"});
  p.gravity.direction = {0, 0, -1};
  EXPECT_EQ(keys(p), std::vector<std::string>{"gravity.direction"});
  p.gravity.direction = {0, 1, -1};
  EXPECT_TRUE(check(p).empty());
}

}  // namespace
}  // namespace talus::cloud
