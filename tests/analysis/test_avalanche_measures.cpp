// SPDX-License-Identifier: Apache-2.0
/// The measures of avalanches, of runs whose numbers are known.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "analysis/avalanche.hpp"

namespace talus {
namespace {

/// A run to t = 20 with 10 data, 2 apart. Front speed: 30 + 4 t up to t = 5, then 50 - (t - 5) - (t - 10)/2 if t > 10.
/// Share leaked: 0.05 t.
AvalancheRun synthetic(CloudMotion motion = CloudMotion::falling) {
  AvalancheRun run{.scales = {1, 1}, .motion = motion};
  auto speed = [=](double t) { return t <= 5 ? 30 + 4 * t : 50 - (t - 5) - 0.5 * std::max(0.0, t - 10); };
  for (int n = 1; n <= 80; ++n) {
    run.front_speed.time.push_back(0.25 * n);
    run.front_speed.value.push_back(speed(0.25 * n));
  }
  run.end = 20;
  std::vector<double> time;
  for (int n = 0; n <= 10; ++n) time.push_back(2.0 * n);
  const auto load = [](std::size_t n) {
    return std::make_shared<const FallSnapshot>(FallSnapshot{{.leaked_fraction = 0.1 * static_cast<double>(n)}, 1});
  };
  run.snapshots = AvalancheRun::Numbers::of(time, load, 2);
  run.overlap_max = 0.01;
  return run;
}

double measure(std::string_view name, const AvalancheRun& run, const Window& window) {
  return find_row(avalanche_measures(), name)->estimator.of(run, window);
}

double of_run(std::string_view name, Window window = {}) {
  return measure(name, synthetic(), window);
}

TEST(AvalancheMeasures, OfAKnownRun) {
  EXPECT_DOUBLE_EQ(of_run("front_speed_max"), 50);
  EXPECT_DOUBLE_EQ(of_run("front_speed_end"), 30);
  EXPECT_DOUBLE_EQ(of_run("front_speed_min"), 30);
  EXPECT_DOUBLE_EQ(of_run("front_speed_min", {.from = 0, .to = 10}), 31);
  EXPECT_DOUBLE_EQ(of_run("front_speed_max", {.from = 10}), 45 - 0.25 * 1.5);
  EXPECT_DOUBLE_EQ(of_run("leaked_fraction", {.at = 3.9}), 0.2);
  EXPECT_DOUBLE_EQ(of_run("leaked_fraction", {.at = 3}), 0.1) << "of two equally near data the earlier";
  EXPECT_DOUBLE_EQ(of_run("leaked_fraction", {.at = 0}), 0.1) << "the start is no datum";
  EXPECT_DOUBLE_EQ(of_run("leaked_fraction", {.at = Window::end_of_run}), 1);
  EXPECT_DOUBLE_EQ(of_run("leaked_fraction"), 1) << "without a time: the end";
  EXPECT_DOUBLE_EQ(of_run("overlap_max"), 0.01);
  EXPECT_TRUE(std::isnan(measure("leaked_fraction", {}, {}))) << "a run without data";
}

TEST(AvalancheSummary, ListsWhatAppliesWithUnits) {
  for (const CloudMotion motion : {CloudMotion::on_slope, CloudMotion::falling, CloudMotion::other}) {
    const auto summary = summary_of(synthetic(motion), avalanche_measures());
    EXPECT_EQ(summary.size(), motion == CloudMotion::on_slope ? 4u : motion == CloudMotion::falling ? 6u : 1u);
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
