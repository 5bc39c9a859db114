// SPDX-License-Identifier: Apache-2.0
/// The measures of avalanches, of runs whose numbers are known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "analysis/avalanche_numbers.hpp"
#include "analysis/reference_rows.hpp"
#include "analysis/row_values.hpp"

namespace talus {
namespace {

using Number = AvalancheRun::Numbers::Number;

/// Numbers of snapshots by hand: `of` makes them all, from the number of the snapshot.
using ByHand = std::map<Number, double>;
AvalancheRun::Numbers numbers(std::vector<double> time, std::function<ByHand(std::size_t)> of) {
  return {std::move(time), [of](std::size_t n, Number number, const Place&) {
            const ByHand all = of(n);
            const auto found = all.find(number);
            return found == all.end() ? AvalancheRun::none : found->second;
          }};
}

/// A run to t = 20 with 10 data, 2 apart. Front speed: 30 + 4 t up to t = 5, then 50 - (t - 5) - (t - 10)/2 if t > 10.
/// Grains in the head: 2000 - 150 t, of 2000; width (60 - t) a, thickness (15 - t/4 + wobble) a. `shift` is added to
/// the front speed.
AvalancheRun synthetic(double shift, double radius, double width_shift = 0) {
  AvalancheRun run{.scales = {radius, 1}, .grains = 2000};
  auto speed = [=](double t) { return (t <= 5 ? 30 + 4 * t : 50 - (t - 5) - 0.5 * std::max(0.0, t - 10)) + shift; };
  for (int n = 1; n <= 80; ++n) {
    run.front_speed.time.push_back(0.25 * n);
    run.front_speed.value.push_back(speed(0.25 * n));
  }
  run.front_speed_last = speed(20);
  run.end = 20;
  std::vector<double> time;
  for (int n = 0; n <= 10; ++n) time.push_back(2.0 * n);
  run.snapshots = numbers(time, [=](std::size_t n) {
    const double t = 2.0 * static_cast<double>(n), width = (60 - t) * radius;
    return ByHand{{avalanche::front_speed, n == 0 ? AvalancheRun::none : speed(t)},
                  {avalanche::head_count, 3},
                  {avalanche::head_particles, std::max(0.0, 2000 - 150 * t)},
                  {avalanche::head<&HeadSize::width>, width},
                  {avalanche::head<&HeadSize::thickness>, width / (n == 5 ? 3.5 : 4)},
                  {avalanche::frontal_angle, 90 - t + (10 - static_cast<double>(n)) * shift}};
  });
  for (int k = 0; k < 4; ++k) run.head_widths.push_back((30 + 2 * k + width_shift) * radius);
  run.overlap_max = 0.01;
  return run;
}

double measure(std::string_view name, const AvalancheRun& run, const Window& window) {
  return find_row(avalanche_measures(), name)->estimator.of(run, {}, window);
}

double of_run(std::string_view name, Window window = {}) {
  return measure(name, synthetic(0, 1), window);
}

const MeasuresOfModel<AvalancheRun>& measures_of_model() {
  static const MeasuresOfModel<AvalancheRun> measures{avalanche_measures(), avalanche_group_measures(), mean_run};
  return measures;
}

std::optional<double> of_row(const ComparisonRow& row, const std::vector<AvalancheRun>& members) {
  return RowValues<AvalancheRun>(row, {&members}, measures_of_model()).values().at(0);
}

TEST(AvalancheMeasures, OfAKnownRun) {
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
  EXPECT_TRUE(std::isnan(measure("head_count", {}, {}))) << "a run without data";
}

TEST(EnsembleQuantity, MeansSpreadsAndPooledValues) {
  const std::vector<AvalancheRun> members = {synthetic(-1, 1), synthetic(0, 1), synthetic(1, 1)};
  auto of = [&](std::string quantity, From from, Statistic statistic = Statistic::mean, std::size_t count = 3) {
    const ComparisonRow row{.quantity = std::move(quantity), .from = from, .statistic = statistic};
    return of_row(row, {members.begin(), members.begin() + static_cast<std::ptrdiff_t>(count)});
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
  EXPECT_THROW(of("head_widht", From::each), std::out_of_range);
}

TEST(EnsembleQuantity, MembersWithoutAnAngleAreLeftOutWhileTheyAreTheFewer) {
  std::vector<AvalancheRun> members = {synthetic(-1, 1), synthetic(0, 1), synthetic(1, 1)};
  const ComparisonRow spread_ratio{.quantity = "frontal_angle_spread_ratio", .from = From::curves};
  const ComparisonRow at_first{.quantity = "frontal_angle_first", .from = From::each, .statistic = Statistic::mean};
  const auto lose_first_angle = [](AvalancheRun& run) {
    const AvalancheRun::Numbers whole = run.snapshots;
    run.snapshots = {whole.time(), [whole](std::size_t n, Number number, const Place& place) {
                       return n == 1 && number == avalanche::frontal_angle ? AvalancheRun::none
                                                                           : whole.value(n, number, place);
                     }};
  };
  lose_first_angle(members[2]);
  // The first datum's standard deviation is now that of two angles, 9 degrees apart.
  EXPECT_NEAR(*of_row(spread_ratio, members), 1 / (9 / std::sqrt(2.0) + 8), 1e-12);
  EXPECT_NEAR(*of_row(at_first, members), 88 - 4.5, 1e-12);
  lose_first_angle(members[1]);
  EXPECT_TRUE(std::isnan(*of_row(spread_ratio, members)));
  EXPECT_TRUE(std::isnan(*of_row(at_first, members)));
}

TEST(EnsembleQuantity, TheAspectRatioIsThatOfTheMeans) {
  std::vector<AvalancheRun> members = {synthetic(0, 1), synthetic(0, 1)};
  members[1].snapshots = numbers(members[0].snapshots.time(), [&](std::size_t n) {
    const double thickness = 2 * members[0].snapshots.value(n, avalanche::head<&HeadSize::thickness>, {});
    return ByHand{{avalanche::head<&HeadSize::width>, 3 * thickness},
                  {avalanche::head<&HeadSize::thickness>, thickness}};
  });
  const auto ratio =
      of_row({.quantity = "head_aspect_ratio_max", .from = From::curves, .window = {.from = 10}}, members);
  EXPECT_NEAR(*ratio, (4 + 2 * 3) / 3.0, 1e-12) << "of means 4 l + 6 l over l + 2 l, not the mean of 4 and 3";
}

TEST(RadiiQuantity, WidthsProportionalToTheRadius) {
  std::vector<std::vector<AvalancheRun>> ensembles = {
      {synthetic(0, 0.001), synthetic(1, 0.001)}, {synthetic(0, 0.0025)}, {synthetic(0, 0.005)}};
  auto of = [&](std::string quantity) {
    const ComparisonRow row{.quantity = std::move(quantity), .from = From::variants};
    std::vector<const std::vector<AvalancheRun>*> groups;
    for (const auto& members : ensembles) groups.push_back(&members);
    return RowValues<AvalancheRun>(row, groups, measures_of_model()).values().at(0);
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
  members[1].snapshots = numbers({0, 1}, [](std::size_t) { return ByHand{}; });
  EXPECT_THROW(mean_run(members), std::invalid_argument);
  EXPECT_THROW(mean_run({}), std::invalid_argument);
}

TEST(AvalancheSummary, ListsWhatAppliesWithUnits) {
  for (const AvalancheView view : {AvalancheView::from_above, AvalancheView::from_the_side, AvalancheView::falling}) {
    AvalancheRun run = synthetic(0, 1);
    run.view = view;
    const auto summary = summary_of(run, avalanche_measures());
    EXPECT_EQ(summary.size(), view == AvalancheView::from_above ? 9u : view == AvalancheView::falling ? 6u : 5u);
    for (const NamedValue& value : summary) EXPECT_EQ(value.unit, find_measure(value.name)->unit);
  }
}

/// Front speeds that rise to the end, whose last window is not one of the curve's.
TEST(AvalancheSummary, KeepsTheOrderOfFrontSpeeds) {
  Curve front;
  for (int n = 0; n <= 110; ++n) {
    front.time.push_back(0.01 * n);
    front.value.push_back(std::pow(0.01 * n, 3));
  }
  const AvalancheRun run = avalanche_run(front, 1.1, {1, 1}, 5);
  EXPECT_GT(run.front_speed_last, measure("front_speed_max", run, {})) << "the window that ends with the run";
  EXPECT_LE(measure("front_speed_end", run, {}), measure("front_speed_max", run, {}));
  EXPECT_GE(measure("front_speed_end", run, {}), measure("front_speed_min", run, {}));
}

TEST(Reference, EveryRowOfThePaperCanBeEvaluated) {
  const std::vector<std::vector<AvalancheRun>> ensembles = {{synthetic(0, 0.001), synthetic(1, 0.001)},
                                                            {synthetic(0, 0.0025), synthetic(1, 0.0025)},
                                                            {synthetic(0, 0.005), synthetic(1, 0.005)}};
  const std::vector<ComparisonRow> rows = test::reference_rows();
  EXPECT_EQ(rows.size(), 56u);
  for (const ComparisonRow& row : rows) {
    const std::optional<MeasureText> found = find_measure(row.quantity);
    ASSERT_TRUE(found) << row.id;
    EXPECT_EQ(found->unit, row.unit) << row.id;
    if (row.from == From::parameters) continue;
    EXPECT_NO_THROW({
      std::vector<const std::vector<AvalancheRun>*> groups;
      for (const auto& members : ensembles) groups.push_back(&members);
      for (const auto& value : RowValues<AvalancheRun>(row, groups, measures_of_model()).values())
        EXPECT_TRUE(value) << row.id;
    }) << row.id;
  }
}

}  // namespace
}  // namespace talus
