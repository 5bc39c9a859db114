// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/avalanche_numbers.hpp"
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

/// A bow of grains as a mean radius and a Stokes speed make it, circulating about its two halves: v_x = 40 - |y|, v_y =
/// y / 2 in units of both.
Grains bow(const AvalancheScales& scales) {
  Grains grains{.time = 3 * scales.time(), .position = {}, .velocity = {}, .radius = {}};
  for (const Vector3& x : test::bow(0, 31)) {
    grains.position.push_back(scales.mean_radius * x);
    grains.velocity.push_back(scales.stokes_speed * Vector3{40 - std::abs(x.y), 0.5 * x.y, 0});
  }
  grains.radius.assign(grains.position.size(), scales.mean_radius);
  return grains;
}

TEST(AvalancheSnapshot, OfABowFromAboveWhateverTheScales) {
  for (const AvalancheScales scales : {AvalancheScales{1, 1}, AvalancheScales{0.005, 39.8}}) {
    const Grains grains = bow(scales);
    const AvalancheSnapshot s(scales, AvalancheView::from_above, grains.view(), 35 * scales.stokes_speed);
    const auto is = [&](Number number) { return number(s, {}); };
    EXPECT_NEAR(is(avalanche::front_speed), 35, 1e-9);
    EXPECT_EQ(is(avalanche::head_count), 1);
    EXPECT_EQ(is(avalanche::head_particles), static_cast<double>(test::grains_of_bow(31)));
    EXPECT_NEAR(is(avalanche::head<&HeadSize::width>), 62 * scales.mean_radius, 1e-12);
    EXPECT_NEAR(is(avalanche::head<&HeadSize::thickness>), 8 * scales.mean_radius, 1e-12);
    EXPECT_NEAR(is(avalanche::head<&HeadSize::concavity>), 1, 1e-12);
    // -d v_x / d y is 1 left of the centre line; at it the sign turns, so that the mean is a little less.
    EXPECT_NEAR(is(avalanche::head_curl<&HeadMotion::curl_left>), 1, 0.05);
    EXPECT_NEAR(is(avalanche::head_curl<&HeadMotion::curl_right>), -is(avalanche::head_curl<&HeadMotion::curl_left>),
                1e-9);
    // Central half: |y| <= 15.5, so y = -14, -12, ..., 14, with a mean |y| of 112 / 15.
    EXPECT_NEAR(is(avalanche::head_motion<&HeadMotion::rear_relative_velocity>), 40 - 112.0 / 15 - 35, 1e-9);
    // All 31 columns: mean |y| 480 / 31.
    EXPECT_NEAR(is(avalanche::head_motion<&HeadMotion::front_outward_velocity>), 0.5 * 480 / 31, 1e-9);
    EXPECT_TRUE(std::isnan(is(avalanche::frontal_angle)));
    EXPECT_TRUE(std::isnan(is(avalanche::fall_speed)));
  }
}

TEST(AvalancheSnapshot, CountsHeadsOfFiveGrainsAndMore) {
  Points points = test::block({0, 0, 0}, 5, 5, 2);
  test::append(points, test::block({0, 50, 0}, 4, 4, 2));
  test::append(points, test::block({0, 90, 0}, 2, 2, 2));
  const Grains grains{0, points, std::vector<Vector3>(points.size()), Radii(points.size(), 1.0)};
  const AvalancheSnapshot s({1, 1}, AvalancheView::from_above, grains.view(), AvalancheRun::none);
  EXPECT_EQ(avalanche::head_count(s, {}), 2);
  EXPECT_EQ(avalanche::head_particles(s, {}), 25);
}

TEST(AvalancheSnapshot, FromTheSide) {
  // A triangle of 12 layers that leans back at 60 degrees ahead of a tail of one layer; the front stands still.
  Points position;
  for (int layer = 0; layer < 12; ++layer)
    for (int n = 0; n < 12 - layer; ++n) position.push_back({-2.0 * n - layer, 7, 1 + layer * std::sqrt(3.0)});
  for (int n = 12; n < 60; ++n) position.push_back({-2.0 * n, 0, 1});
  std::vector<Vector3> velocity;
  for (const Vector3& x : position) velocity.push_back({x.x < -24 ? -4.0 : x.z > 14 ? -2.0 : 1.0, 0, 0});
  const Grains grains{5, position, velocity, Radii(position.size(), 1.0)};
  const AvalancheSnapshot s({1, 2}, AvalancheView::from_the_side, grains.view(), 0);
  EXPECT_EQ(avalanche::front_speed(s, {}), 0);
  EXPECT_NEAR(avalanche::frontal_angle(s, {}), 60, 1e-9) << "y does not count";
  EXPECT_NEAR(avalanche::front_rear_thickness_ratio(s, {}), (2 + 11 * std::sqrt(3.0)) / 2, 1e-12);
  EXPECT_NEAR(avalanche::parts_motion<&HeadTailMotion::upper_head>(s, {}), -1, 1e-12);
  EXPECT_NEAR(avalanche::parts_motion<&HeadTailMotion::lower_head>(s, {}), 0.5, 1e-12);
  EXPECT_LT(avalanche::parts_motion<&HeadTailMotion::tail>(s, {}), 0);
  EXPECT_TRUE(std::isnan(avalanche::head_count(s, {})));
}

TEST(AvalancheSnapshot, HasNoFrontSpeedBeforeTheFirstWindow) {
  const Curve front{{0, 0.2, 0.4}, {0, 1, 2}};
  EXPECT_TRUE(std::isnan(front_speed_at(front, 0.2, {1, 1})));
  EXPECT_NEAR(front_speed_at(front, 0.3, {1, 1}), 5, 1e-12);
  const Grains one{0.2, {{0, 0, 0}}, {{}}, {1}};
  const AvalancheSnapshot s({1, 1}, AvalancheView::from_above, one.view(), AvalancheRun::none);
  EXPECT_EQ(avalanche::head_count(s, {}), 0);
  EXPECT_EQ(avalanche::head_particles(s, {}), 0);
  EXPECT_TRUE(std::isnan(avalanche::head<&HeadSize::width>(s, {})));
  EXPECT_TRUE(std::isnan(avalanche::head_curl<&HeadMotion::curl_left>(s, {})));
}

TEST(AvalancheRun, FromTheRecordsOfTheFront) {
  // 2 mm and 4 m/s make a/v_s 0.5 ms; the front runs at 80 m/s = 20 v_s.
  const AvalancheScales scales{0.002, 4};
  Curve front;
  for (int n = 0; n <= 110; ++n) {
    front.time.push_back(n * 1e-5);
    front.value.push_back(7 + 80 * n * 1e-5);
  }
  const AvalancheRun run = avalanche_run(front, 1e-3, scales, 5);
  ASSERT_EQ(run.front_speed.time.size(), 8u) << "the run ends at 2 a/v_s, the records a little later";
  EXPECT_DOUBLE_EQ(run.front_speed.time.back(), 2);
  for (const double v : run.front_speed.value) EXPECT_NEAR(v, 20, 1e-9);
  EXPECT_NEAR(run.front_speed_last, 20, 1e-9);
}

TEST(AvalancheRun, HasNoFrontSpeedWhereNoWindowFits) {
  const AvalancheScales scales{0.002, 4};  // a window is 0.125 ms
  const Curve front{{0, 1e-4, 2e-4}, {0, 0.01, 0.02}};
  EXPECT_EQ(avalanche_run(front, 2e-4, scales, 5).front_speed.time.size(), 1u);
  EXPECT_NEAR(avalanche_run(front, 2e-4, scales, 5).front_speed_last, 25, 1e-9);
  const AvalancheRun brief = avalanche_run(front, 1e-4, scales, 5);
  EXPECT_TRUE(brief.front_speed.time.empty());
  EXPECT_TRUE(std::isnan(brief.front_speed_last));
  const AvalancheRun outlived = avalanche_run(front, 5e-4, scales, 5);  // no grain was a front at the end
  EXPECT_EQ(outlived.front_speed.time.size(), 1u);
  EXPECT_TRUE(std::isnan(outlived.front_speed_last));
  EXPECT_TRUE(std::isnan(avalanche_run({}, 5e-4, scales, 5).front_speed_last));
}

}  // namespace
}  // namespace talus
