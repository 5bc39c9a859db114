// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/lattice.hpp"

namespace talus {
namespace {

using test::Points;

using Number = AvalancheRun::Numbers::Number;
using Radii = std::vector<double>;

/// Grains with their radii and velocities.
struct Grains {
  double time = 0;
  std::vector<Vector3> position, velocity;
  std::vector<double> radius;

  Snapshot view() const {
    return {.time = time,
            .step = 0,
            .columns = {{"position", "m", std::span<const Vector3>(position)},
                        {"radius", "m", std::span<const double>(radius)},
                        {"velocity", "m/s", std::span<const Vector3>(velocity)}}};
  }
};

/// A bow of grains as a mean radius and a Stokes speed make it.
Grains bow(const AvalancheScales& scales) {
  Grains grains{.time = 3 * scales.time(), .position = {}, .velocity = {}, .radius = {}};
  for (const Vector3& x : test::bow(0, 31)) {
    grains.position.push_back(scales.mean_radius * x);
    grains.velocity.push_back({scales.stokes_speed, 0, 0});
  }
  grains.radius.assign(grains.position.size(), scales.mean_radius);
  return grains;
}

TEST(AvalancheSnapshot, OfABowFromAboveWhateverTheScales) {
  for (const AvalancheScales scales : {AvalancheScales{1, 1}, AvalancheScales{0.005, 39.8}}) {
    const Grains grains = bow(scales);
    const AvalancheSnapshot s(scales, AvalancheView::from_above, grains.view());
    const auto is = [&](Number number) { return number(s); };
    EXPECT_EQ(is(avalanche::head_count), 1);
    EXPECT_EQ(is(avalanche::head_particles), static_cast<double>(test::grains_of_bow(31)));
    EXPECT_NEAR(is(avalanche::head<&HeadSize::width>), 62 * scales.mean_radius, 1e-12);
    EXPECT_NEAR(is(avalanche::head<&HeadSize::thickness>), 8 * scales.mean_radius, 1e-12);
    EXPECT_TRUE(std::isnan(is(avalanche::frontal_angle)));
    EXPECT_TRUE(std::isnan(is(avalanche::fall_speed)));
  }
}

TEST(AvalancheSnapshot, CountsHeadsOfFiveGrainsAndMore) {
  Points points = test::block({0, 0, 0}, 5, 5, 2);
  test::append(points, test::block({0, 50, 0}, 4, 4, 2));
  test::append(points, test::block({0, 90, 0}, 2, 2, 2));
  const Grains grains{0, points, std::vector<Vector3>(points.size()), Radii(points.size(), 1.0)};
  const AvalancheSnapshot s({1, 1}, AvalancheView::from_above, grains.view());
  EXPECT_EQ(avalanche::head_count(s), 2);
  EXPECT_EQ(avalanche::head_particles(s), 25);
}

TEST(AvalancheSnapshot, FromTheSide) {
  // A triangle of 12 layers that leans back at 60 degrees ahead of a tail of one layer; the front stands still.
  Points position;
  for (int layer = 0; layer < 12; ++layer)
    for (int n = 0; n < 12 - layer; ++n) position.push_back({-2.0 * n - layer, 7, 1 + layer * std::sqrt(3.0)});
  for (int n = 12; n < 60; ++n) position.push_back({-2.0 * n, 0, 1});
  const Grains grains{5, position, std::vector<Vector3>(position.size()), Radii(position.size(), 1.0)};
  const AvalancheSnapshot s({1, 2}, AvalancheView::from_the_side, grains.view());
  EXPECT_NEAR(avalanche::frontal_angle(s), 60, 1e-9) << "y does not count";
  EXPECT_TRUE(std::isnan(avalanche::head_count(s)));
}

TEST(AvalancheSnapshot, OfOneGrain) {
  const Grains one{0.2, {{0, 0, 0}}, {{}}, {1}};
  const AvalancheSnapshot s({1, 1}, AvalancheView::from_above, one.view());
  EXPECT_EQ(avalanche::head_count(s), 0);
  EXPECT_EQ(avalanche::head_particles(s), 0);
  EXPECT_TRUE(std::isnan(avalanche::head<&HeadSize::width>(s)));
}

TEST(AvalancheRun, FromTheRecordsOfTheFront) {
  // 2 mm and 4 m/s make a/v_s 0.5 ms; the front runs at 80 m/s = 20 v_s.
  const AvalancheScales scales{0.002, 4};
  Curve front;
  for (int n = 0; n <= 110; ++n) {
    front.time.push_back(n * 1e-5);
    front.value.push_back(7 + 80 * n * 1e-5);
  }
  const AvalancheRun run = avalanche_run(front, 1e-3, scales);
  ASSERT_EQ(run.front_speed.time.size(), 8u) << "the run ends at 2 a/v_s, the records a little later";
  EXPECT_DOUBLE_EQ(run.front_speed.time.back(), 2);
  for (const double v : run.front_speed.value) EXPECT_NEAR(v, 20, 1e-9);
}

TEST(AvalancheRun, HasNoFrontSpeedWhereNoWindowFits) {
  const AvalancheScales scales{0.002, 4};  // a window is 0.125 ms
  const Curve front{{0, 1e-4, 2e-4}, {0, 0.01, 0.02}};
  EXPECT_EQ(avalanche_run(front, 2e-4, scales).front_speed.time.size(), 1u);
  EXPECT_TRUE(avalanche_run(front, 1e-4, scales).front_speed.time.empty());
  EXPECT_EQ(avalanche_run(front, 5e-4, scales).front_speed.time.size(), 1u) << "no grain was a front at the end";
}

}  // namespace
}  // namespace talus
