// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/avalanche_quantities.hpp"
#include "analysis/lattice.hpp"
#include "analysis/quantities.hpp"
#include "analysis/reference_rows.hpp"

namespace talus {
namespace {

using test::Points;

/// A bow of grains as a mean radius and a Stokes speed make it, circulating about its two halves: v_x = 40 - |y|, v_y =
/// y / 2 in units of both; seen at a time of 3 after the front has run at 35.
AvalancheFrame frame_of_bow(const AvalancheScales& scales) {
  const double a = scales.mean_radius, v = scales.stokes_speed;
  Points position;
  std::vector<Vector3> velocity;
  for (const Vector3& x : test::bow(0, 31)) {
    position.push_back(a * x);
    velocity.push_back(v * Vector3{40 - std::abs(x.y), 0.5 * x.y, 0});
  }
  const std::vector<double> radius(position.size(), a);
  Curve front;
  for (int n = 0; n <= 400; ++n) {
    front.time.push_back(n * 0.01 * scales.time());
    front.value.push_back(35 * n * 0.01 * a);
  }
  return avalanche_frame({3 * scales.time(), position, radius, velocity}, front, scales, AvalancheView::from_above);
}

TEST(AvalancheFrame, OfABowFromAboveWhateverTheScales) {
  for (const AvalancheScales scales : {AvalancheScales{1, 1}, AvalancheScales{0.005, 39.8}}) {
    const AvalancheFrame frame = frame_of_bow(scales);
    EXPECT_NEAR(frame.time, 3, 1e-12);
    EXPECT_NEAR(frame.front_speed, 35, 1e-9);
    EXPECT_EQ(frame.head_count, 1);
    EXPECT_EQ(frame.head_particles, static_cast<double>(test::grains_of_bow(31)));
    EXPECT_NEAR(frame.head_width, 62 * scales.mean_radius, 1e-12);
    EXPECT_NEAR(frame.head_thickness, 8 * scales.mean_radius, 1e-12);
    EXPECT_NEAR(frame.head_concavity, 1, 1e-12);
    ASSERT_EQ(frame.head_widths.size(), 1u);
    EXPECT_EQ(frame.head_widths[0], frame.head_width);
    // -d v_x / d y is 1 left of the centre line; at it the sign turns, so that the mean is a little less.
    EXPECT_NEAR(frame.head_curl_left, 1, 0.05);
    EXPECT_NEAR(frame.head_curl_right, -frame.head_curl_left, 1e-9);
    // Central half: |y| <= 15.5, so y = -14, -12, ..., 14, with a mean |y| of 112 / 15.
    EXPECT_NEAR(frame.head_rear_relative_velocity, 40 - 112.0 / 15 - 35, 1e-9);
    // All 31 columns: mean |y| 480 / 31.
    EXPECT_NEAR(frame.head_front_outward_velocity, 0.5 * 480 / 31, 1e-9);
    EXPECT_TRUE(std::isnan(frame.frontal_angle));
  }
}

TEST(AvalancheFrame, CountsHeadsOfFiveGrainsAndMore) {
  Points points = test::block({0, 0, 0}, 5, 5, 2);
  test::append(points, test::block({0, 50, 0}, 4, 4, 2));
  test::append(points, test::block({0, 90, 0}, 2, 2, 2));
  const std::vector<Vector3> velocity(points.size());
  const std::vector<double> radius(points.size(), 1.0);
  const AvalancheFrame frame = avalanche_frame({0, points, radius, velocity}, {}, {1, 1}, AvalancheView::from_above);
  EXPECT_EQ(frame.head_count, 2);
  EXPECT_EQ(frame.head_particles, 25);
}

TEST(AvalancheFrame, FromTheSide) {
  // A triangle of 12 layers that leans back at 60 degrees ahead of a tail of one layer; the front stands still.
  Points position;
  for (int layer = 0; layer < 12; ++layer)
    for (int n = 0; n < 12 - layer; ++n) position.push_back({-2.0 * n - layer, 0, 1 + layer * std::sqrt(3.0)});
  for (int n = 12; n < 60; ++n) position.push_back({-2.0 * n, 0, 1});
  std::vector<Vector3> velocity;
  for (const Vector3& x : position) velocity.push_back({x.x < -24 ? -4.0 : x.z > 14 ? -2.0 : 1.0, 0, 0});
  const std::vector<double> radius(position.size(), 1.0);
  const Curve front{{0, 5}, {0, 0}};
  const AvalancheScales scales{1, 2};
  const AvalancheFrame frame =
      avalanche_frame({5, position, radius, velocity}, front, scales, AvalancheView::from_the_side);
  EXPECT_EQ(frame.front_speed, 0);
  EXPECT_NEAR(frame.frontal_angle, 60, 1e-9);
  EXPECT_NEAR(frame.front_rear_thickness_ratio, (2 + 11 * std::sqrt(3.0)) / 2, 1e-12);
  EXPECT_NEAR(frame.head_upper_relative_velocity, -1, 1e-12);
  EXPECT_NEAR(frame.head_lower_relative_velocity, 0.5, 1e-12);
  EXPECT_LT(frame.tail_relative_velocity, 0);
  EXPECT_TRUE(std::isnan(frame.head_count));
}

TEST(AvalancheFrame, HasNoFrontSpeedBeforeTheFirstWindow) {
  const Points one = {{0, 0, 0}};
  const std::vector<Vector3> velocity(1);
  const std::vector<double> radius(1, 1.0);
  const Curve front{{0, 0.2}, {0, 1}};
  const AvalancheFrame frame = avalanche_frame({0.2, one, radius, velocity}, front, {1, 1}, AvalancheView::from_above);
  EXPECT_TRUE(std::isnan(frame.front_speed));
  EXPECT_EQ(frame.head_count, 0);
  EXPECT_EQ(frame.head_particles, 0);
  EXPECT_TRUE(std::isnan(frame.head_width));
}

/// A run to t = 20 with 10 data, 2 apart. Front speed: 30 + 4 t up to t = 5, then 50 - (t - 5) - (t - 10)/2 if t > 10.
/// Grains in the head: 2000 - 150 t, of 2000; width (60 - t) a, thickness (15 - t/4 + wobble) a. `shift` is added to
/// the front speed.
AvalancheRun synthetic(double shift, double radius, double width_shift = 0) {
  AvalancheRun run{.scales = {radius, 1}, .grains = 2000};
  auto speed = [&](double t) { return (t <= 5 ? 30 + 4 * t : 50 - (t - 5) - 0.5 * std::max(0.0, t - 10)) + shift; };
  for (int n = 1; n <= 80; ++n) {
    run.front_speed.time.push_back(0.25 * n);
    run.front_speed.value.push_back(speed(0.25 * n));
  }
  run.front_speed_end = speed(20);
  for (int n = 0; n <= 10; ++n) {
    AvalancheFrame frame;
    frame.time = 2.0 * n;
    frame.front_speed = n == 0 ? AvalancheFrame::none : speed(frame.time);
    frame.head_count = 3;
    frame.head_particles = std::max(0.0, 2000 - 150 * frame.time);
    frame.head_width = (60 - frame.time) * radius;
    frame.head_thickness = frame.head_width / (n == 5 ? 3.5 : 4);
    frame.frontal_angle = 90 - frame.time + (10 - n) * shift;
    for (int k = 0; k < 4; ++k) frame.head_widths.push_back((30 + 2 * k + width_shift) * radius);
    run.frames.push_back(frame);
  }
  run.overlap_max = 0.01;
  return run;
}

double of_run(std::string_view name, Window window = {}) {
  return run_quantity(name, synthetic(0, 1), window);
}

TEST(RunQuantity, OfAKnownRun) {
  EXPECT_DOUBLE_EQ(of_run("front_speed_max"), 50);
  EXPECT_DOUBLE_EQ(of_run("front_speed_max_time"), 5);
  EXPECT_DOUBLE_EQ(of_run("front_speed_end"), 30);
  EXPECT_DOUBLE_EQ(of_run("front_speed_min"), 30);
  EXPECT_DOUBLE_EQ(of_run("front_speed_min", {.from = 0, .to = 10}), 31);
  EXPECT_DOUBLE_EQ(of_run("front_speed_max", {.from = 10}), 45 - 0.25 * 1.5);
  EXPECT_DOUBLE_EQ(of_run("front_speed_rise"), 50.0 / 31);
  EXPECT_DOUBLE_EQ(of_run("front_speed_fall"), 50.0 / 30);
  EXPECT_NEAR(of_run("front_speed_slope_early") + of_run("front_speed_slope_change"), -1.5, 1e-10);
  EXPECT_GT(of_run("front_speed_slope_early"), 0);

  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = 3.9}), 1400);
  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = 3}), 1700) << "of two equally near data the earlier";
  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = 0}), 1700) << "the start is no datum";
  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = Window::end_of_run}), 0);
  EXPECT_DOUBLE_EQ(of_run("head_particles"), 0) << "without a time: the end";
  EXPECT_DOUBLE_EQ(of_run("head_aspect_ratio", {.from = 6}), (6 * 4 + 3.5) / 7);
  EXPECT_DOUBLE_EQ(of_run("head_aspect_ratio_min", {.from = 6}), 3.5);
  EXPECT_DOUBLE_EQ(of_run("head_aspect_ratio_max", {.from = 6}), 4);
  EXPECT_DOUBLE_EQ(of_run("head_particles_first"), 0.85);
  EXPECT_NEAR(of_run("head_particles_half_time"), 1000 / 150.0, 1e-12);
  // 14, 16, 18 and 20 share the last place with 0 grains: ranks 1 to 6 fall, the last four are tied.
  EXPECT_NEAR(of_run("head_particles_trend"), -(82.5 - 5) / std::sqrt(82.5 * (82.5 - 5)), 1e-12);
  EXPECT_GT(of_run("head_particles_front_speed_correlation"), 0.9);
  EXPECT_LT(of_run("head_particles_front_speed_correlation_all"), of_run("head_particles_front_speed_correlation"));
  EXPECT_DOUBLE_EQ(of_run("frontal_angle_first"), 88);
  EXPECT_DOUBLE_EQ(of_run("overlap_max"), 0.01);
  EXPECT_THROW(of_run("front_speed_spread"), std::out_of_range) << "takes an ensemble";
  EXPECT_THROW(of_run("head_widht"), std::out_of_range);
  EXPECT_THROW(run_quantity("head_count", {}, {}), std::invalid_argument) << "a run without data";
}

TEST(EnsembleQuantity, MeansSpreadsAndPooledValues) {
  const std::vector<AvalancheRun> members = {synthetic(-1, 1), synthetic(0, 1), synthetic(1, 1)};
  auto of = [&](std::string quantity, From from, Statistic statistic = Statistic::mean, std::size_t count = 3) {
    return ensemble_quantity({.quantity = std::move(quantity), .from = from, .statistic = statistic},
                             std::span(members).first(count));
  };
  EXPECT_DOUBLE_EQ(*of("front_speed_max", From::curves), 50);
  EXPECT_DOUBLE_EQ(*of("front_speed_max", From::each, Statistic::standard_deviation), 1);
  EXPECT_DOUBLE_EQ(*of("front_speed_max", From::each, Statistic::median), 50);
  double expected = 0;
  for (const double v : members[1].front_speed.value) expected += 1 / v / 80;
  EXPECT_NEAR(*of("front_speed_spread", From::curves), expected, 1e-14);
  // The angles' standard deviation is 10 - n at datum n of 10: a quarter is 2 data, 9 and 8 against 1 and 0.
  EXPECT_NEAR(*of("frontal_angle_spread_ratio", From::curves), 1.0 / 17, 1e-12);
  EXPECT_NEAR(*of("head_width_skewness", From::values), 0, 1e-12);
  EXPECT_GT(*of("head_width_normality_p_value", From::values), 0);

  EXPECT_EQ(of("front_speed_spread", From::curves, Statistic::mean, 1), std::nullopt);
  EXPECT_EQ(of("head_count", From::each, Statistic::standard_deviation, 1), std::nullopt);
  EXPECT_EQ(of("head_count", From::each, Statistic::mean, 0), std::nullopt);
  EXPECT_EQ(of("head_count", From::each, Statistic::mean, 1), 3);
  EXPECT_THROW(of("head_count", From::values), std::out_of_range);
}

TEST(EnsembleQuantity, MembersWithoutAnAngleAreLeftOutWhileTheyAreTheFewer) {
  std::vector<AvalancheRun> members = {synthetic(-1, 1), synthetic(0, 1), synthetic(1, 1)};
  const ComparisonRow spread_ratio{.quantity = "frontal_angle_spread_ratio", .from = From::curves};
  const ComparisonRow at_first{.quantity = "frontal_angle_first", .from = From::each, .statistic = Statistic::mean};
  members[2].frames[1].frontal_angle = AvalancheFrame::none;
  // The first datum's standard deviation is now that of two angles, 9 degrees apart.
  EXPECT_NEAR(*ensemble_quantity(spread_ratio, members), 1 / (9 / std::sqrt(2.0) + 8), 1e-12);
  EXPECT_NEAR(*ensemble_quantity(at_first, members), 88 - 4.5, 1e-12);
  members[1].frames[1].frontal_angle = AvalancheFrame::none;
  EXPECT_TRUE(std::isnan(*ensemble_quantity(spread_ratio, members)));
  EXPECT_TRUE(std::isnan(*ensemble_quantity(at_first, members)));
}

TEST(EnsembleQuantity, TheAspectRatioIsThatOfTheMeans) {
  std::vector<AvalancheRun> members = {synthetic(0, 1), synthetic(0, 1)};
  for (AvalancheFrame& frame : members[1].frames) frame.head_width = 3 * frame.head_thickness;
  for (AvalancheFrame& frame : members[1].frames) frame.head_width *= 2, frame.head_thickness *= 2;
  const auto ratio =
      ensemble_quantity({.quantity = "head_aspect_ratio_max", .from = From::curves, .window = {.from = 10}}, members);
  EXPECT_NEAR(*ratio, (4 + 2 * 3) / 3.0, 1e-12) << "of means 4 l + 6 l over l + 2 l, not the mean of 4 and 3";
}

TEST(RadiiQuantity, WidthsProportionalToTheRadius) {
  std::vector<std::vector<AvalancheRun>> ensembles = {
      {synthetic(0, 0.001), synthetic(1, 0.001)}, {synthetic(0, 0.0025)}, {synthetic(0, 0.005)}};
  auto of = [&](std::string quantity) {
    return radii_quantity({.quantity = std::move(quantity), .from = From::variants}, ensembles);
  };
  EXPECT_NEAR(*of("head_width_line_r_squared"), 1, 1e-12);
  EXPECT_NEAR(*of("head_width_line_origin_r_squared"), 1, 1e-12);
  EXPECT_NEAR(*of("head_width_median_spread"), 0, 1e-12);
  ensembles[1] = {synthetic(0, 0.0025, 11)};
  EXPECT_NEAR(*of("head_width_median_spread"), 11 / ((33 + 44 + 33) / 3.0), 1e-12);
  EXPECT_LT(*of("head_width_line_origin_r_squared"), 0.999);
  ensembles.pop_back();
  EXPECT_EQ(of("head_width_line_r_squared"), std::nullopt);
  ensembles.push_back({});
  EXPECT_EQ(of("head_width_line_r_squared"), std::nullopt);
}

TEST(MeanRun, RefusesMembersThatDiffer) {
  std::vector<AvalancheRun> members = {synthetic(0, 1), synthetic(0, 1)};
  members[1].frames.pop_back();
  EXPECT_THROW(mean_run(members), std::invalid_argument);
  EXPECT_THROW(mean_run({}), std::invalid_argument);
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
  EXPECT_NEAR(run.front_speed_end, 20, 1e-9);
}

TEST(AvalancheRun, HasNoFrontSpeedWhereNoWindowFits) {
  const AvalancheScales scales{0.002, 4};  // a window is 0.125 ms
  const Curve front{{0, 1e-4, 2e-4}, {0, 0.01, 0.02}};
  EXPECT_EQ(avalanche_run(front, 2e-4, scales, 5).front_speed.time.size(), 1u);
  EXPECT_NEAR(avalanche_run(front, 2e-4, scales, 5).front_speed_end, 25, 1e-9);
  const AvalancheRun brief = avalanche_run(front, 1e-4, scales, 5);
  EXPECT_TRUE(brief.front_speed.time.empty());
  EXPECT_TRUE(std::isnan(brief.front_speed_end));
  const AvalancheRun outlived = avalanche_run(front, 5e-4, scales, 5);  // no grain was a front at the end
  EXPECT_EQ(outlived.front_speed.time.size(), 1u);
  EXPECT_TRUE(std::isnan(outlived.front_speed_end));
  EXPECT_TRUE(std::isnan(avalanche_run({}, 5e-4, scales, 5).front_speed_end));
}

TEST(AvalancheSummary, ListsWhatAppliesWithUnits) {
  for (const AvalancheView view : {AvalancheView::from_above, AvalancheView::from_the_side}) {
    const auto summary = avalanche_summary(synthetic(0, 1), view);
    EXPECT_EQ(summary.size(), view == AvalancheView::from_above ? 9u : 5u);
    for (const NamedValue& value : summary) {
      ASSERT_NE(find_quantity(value.name), nullptr) << value.name;
      EXPECT_EQ(value.unit, find_quantity(value.name)->unit);
      EXPECT_FALSE(std::isnan(value.value)) << value.name;
    }
  }
  EXPECT_DOUBLE_EQ(avalanche_summary(synthetic(0, 1), AvalancheView::from_above)[7].value, (6 * 4 + 3.5) / 7);
}

TEST(Reference, EveryRowOfThePaperCanBeEvaluated) {
  const std::vector<std::vector<AvalancheRun>> ensembles = {{synthetic(0, 0.001), synthetic(1, 0.001)},
                                                            {synthetic(0, 0.0025), synthetic(1, 0.0025)},
                                                            {synthetic(0, 0.005), synthetic(1, 0.005)}};
  const std::vector<ComparisonRow> rows = test::reference_rows();
  EXPECT_EQ(rows.size(), 56u);
  for (const ComparisonRow& row : rows) {
    const QuantityDefinition* quantity = find_quantity(row.quantity);
    ASSERT_NE(quantity, nullptr) << row.id;
    EXPECT_EQ(quantity->unit, row.unit) << row.id;
    if (row.from == From::parameters) continue;
    EXPECT_NO_THROW({
      const auto value =
          row.from == From::variants ? radii_quantity(row, ensembles) : ensemble_quantity(row, ensembles[0]);
      EXPECT_TRUE(value) << row.id;
    }) << row.id;
  }
}

}  // namespace
}  // namespace talus
