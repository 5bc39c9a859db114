// SPDX-License-Identifier: Apache-2.0
/// The measures of avalanches, of runs whose numbers are known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "analysis/avalanche.hpp"

namespace talus {
namespace {

using Number = AvalancheRun::Numbers::Number;

/// Numbers of snapshots by hand: `of` makes them all, from the number of the snapshot.
using ByHand = std::map<Number, double>;
AvalancheRun::Numbers numbers(std::vector<double> time, std::function<ByHand(std::size_t)> of) {
  return {std::move(time), [of](std::size_t n, Number number) {
            const ByHand all = of(n);
            const auto found = all.find(number);
            return found == all.end() ? AvalancheRun::none : found->second;
          }};
}

/// A run to t = 20 with 10 data, 2 apart. Front speed: 30 + 4 t up to t = 5, then 50 - (t - 5) - (t - 10)/2 if t > 10.
/// Grains in the head: 2000 - 150 t, of 2000; width (60 - t) a, thickness (15 - t/4 + wobble) a. `shift` is added to
/// the front speed.
AvalancheRun synthetic(double shift, double radius) {
  AvalancheRun run{.scales = {radius, 1}};
  auto speed = [=](double t) { return (t <= 5 ? 30 + 4 * t : 50 - (t - 5) - 0.5 * std::max(0.0, t - 10)) + shift; };
  for (int n = 1; n <= 80; ++n) {
    run.front_speed.time.push_back(0.25 * n);
    run.front_speed.value.push_back(speed(0.25 * n));
  }
  run.end = 20;
  std::vector<double> time;
  for (int n = 0; n <= 10; ++n) time.push_back(2.0 * n);
  run.snapshots = numbers(time, [=](std::size_t n) {
    const double t = 2.0 * static_cast<double>(n), width = (60 - t) * radius;
    return ByHand{{avalanche::head_count, 3},
                  {avalanche::head_particles, std::max(0.0, 2000 - 150 * t)},
                  {avalanche::head<&HeadSize::width>, width},
                  {avalanche::head<&HeadSize::thickness>, width / (n == 5 ? 3.5 : 4)},
                  {avalanche::frontal_angle, 90 - t + (10 - static_cast<double>(n)) * shift}};
  });
  run.overlap_max = 0.01;
  return run;
}

double measure(std::string_view name, const AvalancheRun& run, const Window& window) {
  return find_row(avalanche_measures(), name)->estimator.of(run, window);
}

double of_run(std::string_view name, Window window = {}) {
  return measure(name, synthetic(0, 1), window);
}

TEST(AvalancheMeasures, OfAKnownRun) {
  EXPECT_DOUBLE_EQ(of_run("front_speed_max"), 50);
  EXPECT_DOUBLE_EQ(of_run("front_speed_end"), 30);
  EXPECT_DOUBLE_EQ(of_run("front_speed_min"), 30);
  EXPECT_DOUBLE_EQ(of_run("front_speed_min", {.from = 0, .to = 10}), 31);
  EXPECT_DOUBLE_EQ(of_run("front_speed_max", {.from = 10}), 45 - 0.25 * 1.5);
  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = 3.9}), 1400);
  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = 3}), 1700) << "of two equally near data the earlier";
  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = 0}), 1700) << "the start is no datum";
  EXPECT_DOUBLE_EQ(of_run("head_particles", {.at = Window::end_of_run}), 0);
  EXPECT_DOUBLE_EQ(of_run("head_particles"), 0) << "without a time: the end";
  EXPECT_DOUBLE_EQ(of_run("head_aspect_ratio", {.from = 6}), (6 * 4 + 3.5) / 7);
  EXPECT_DOUBLE_EQ(of_run("overlap_max"), 0.01);
  EXPECT_TRUE(std::isnan(measure("head_count", {}, {}))) << "a run without data";
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

/// Front speeds that rise to the end.
TEST(AvalancheSummary, KeepsTheOrderOfFrontSpeeds) {
  Curve front;
  for (int n = 0; n <= 110; ++n) {
    front.time.push_back(0.01 * n);
    front.value.push_back(std::pow(0.01 * n, 3));
  }
  const AvalancheRun run = avalanche_run(front, 1.1, {1, 1});
  EXPECT_LE(measure("front_speed_end", run, {}), measure("front_speed_max", run, {}));
  EXPECT_GE(measure("front_speed_end", run, {}), measure("front_speed_min", run, {}));
}

}  // namespace
}  // namespace talus
