// SPDX-License-Identifier: Apache-2.0
/// A run from a hopper made by hand, whose numbers are known.
#include "analysis/hopper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>

#include "analysis/hopper_estimators.hpp"
#include "analysis/paper_hopper.hpp"

namespace talus {
namespace {

using namespace paper_hopper;
using std::numbers::pi;

/// Numbers of 21 snapshots, one every 50 ms.
double number_by_hand(std::size_t snapshot, HopperRun::Numbers::Number number) {
  const auto n = static_cast<int>(snapshot);
  const std::map<HopperRun::Numbers::Number, double> numbers = {
      {hopper::surface_angle_in<hopper::Where::hopper>, n < 2     ? 0.5
                                                        : n == 10 ? 12
                                                                  : std::min(30, 3 * n)},
      {hopper::surface_angle_in<hopper::Where::bin>, n},
      {hopper::packing_max, n == 3 ? 0.7 : 0.6},
      {hopper::repose_angle_in<hopper::Where::bin, &ReposeAngle::mean>, 28},
      {hopper::repose_angle_in<hopper::Where::hopper, &ReposeAngle::mean>, 33},
      {hopper::stress_ratio, n == 0 ? 0.6 : 0.7},
      {hopper::mass, setting().mass()}};
  const auto found = numbers.find(number);
  return found == numbers.end() ? no_value : found->second;
}

/// Mass leaves at 0.2 kg/s, which swings with a period of 6 ms, from 0.02 s after the opening to 0.3 s; at 0.04 s a
/// bump.
HopperRun run_of_a_steady_flow() {
  HopperRun run{.setting = setting(), .series = {}, .gate_time = gate};
  const double total = run.setting.mass(), weight = total * 9.8;
  const auto column = [&](const char* name, auto&& value) {
    run.series.names.push_back(name);
    run.series.units.push_back("1");
    run.series.columns.emplace_back();
    for (int n = 0; n <= 62500; ++n) run.series.columns.back().push_back(value(2e-5 * n));
  };
  constexpr double bump = 0.05, bump_width = 3e-3;
  const auto passed = [](double t) {
    t = std::clamp(t, 0.02, 0.3) - 0.02;
    return 0.2 * t + 0.02 * 0.006 / (2 * pi) * (1 - std::cos(2 * pi * t / 0.006)) +
           bump * bump_width * std::sqrt(pi) / 2 * (1 + std::erf((t - 0.02) / bump_width));
  };
  column("time", [](double t) { return t; });
  column("gate_time", [](double t) { return t < gate ? -1 : gate; });
  column("discharged_mass", [&](double t) { return passed(t - gate); });
  column("discharge_rate", [&](double t) {
    const double flowing = t - gate - 0.02;
    return flowing < 0 || flowing > 0.28 ? 0
                                         : 0.2 + 0.02 * std::sin(2 * pi * flowing / 0.006) +
                                               bump * std::exp(-std::pow((flowing - 0.02) / bump_width, 2));
  });
  column("lowest_z", [&](double t) { return 0.1 - 4.9 * std::pow(std::max(0.0, t - gate), 2); });
  column("mass_near_floor", [&](double t) { return t - gate < 0.15 ? 0 : total; });
  column("slit_velocity", [&](double t) { return -0.5 - 0.3 * std::exp(-std::pow((t - gate - 0.03) / 5e-3, 2)); });
  column("momentum_x", [](double) { return 0; });
  column("momentum_y", [](double) { return 0; });
  column("momentum_z", [](double) { return 0; });
  column("impulse_gravity_x", [](double) { return 0; });
  column("impulse_gravity_y", [](double) { return 0; });
  column("impulse_gravity_z", [&](double t) { return -weight * t; });
  column("impulse_plate_x", [](double) { return 0; });
  column("impulse_plate_y", [](double) { return 0; });
  column("impulse_plate_z", [&](double t) { return -weight * t; });
  std::vector<double> time;
  for (int n = 0; n <= 20; ++n) time.push_back(0.05 * n);
  run.snapshots = {time, number_by_hand};
  return run;
}

double measure(std::string_view name, const HopperRun& run, const Window& window) {
  return find_row(hopper_measures(), name)->estimator.of(run, window);
}

TEST(Hopper, TheWeightIsOfTheGrainsThatAreThere) {
  HopperRun run = run_of_a_steady_flow();
  const auto add = [&](const char* name, double value) {
    run.series.names.push_back(name), run.series.units.push_back("kg");
    run.series.columns.emplace_back(run.series.columns.front().size(), value);
  };
  add("fed_mass", run.setting.mass());
  add("removed_mass", 0.5 * run.setting.mass());
  EXPECT_NEAR(measure("weight_balance_error", run, {.at = 1}), 1 / 1.5 - 1, 1e-9);
}

TEST(Hopper, QuantitiesOfARun) {
  const HopperRun run = run_of_a_steady_flow();
  const auto is = [&](std::string_view name, const Window& window) { return measure(name, run, window); };
  const Window plateau{.at = {}, .from = 0.05, .to = 0.2}, early{.at = {}, .from = 0, .to = 0.1};
  EXPECT_NEAR(is("discharge_rate_plateau", plateau), 0.2, 2e-4);
  EXPECT_NEAR(is("discharge_rate_extreme_time", early), 0.04, 3e-4) << "means over a period do not swing";
  EXPECT_NEAR(is("slit_velocity_extreme_time", early), 0.03, 3e-4);
  EXPECT_NEAR(is("discharge_rate_max", {.at = {}, .from = 0.03, .to = 0.4}), 0.2 + 0.05 * 3e-3 * std::sqrt(pi) / 0.02,
              0.004);
  EXPECT_NEAR(is("discharge_rate_max_time", {.at = {}, .from = 0.03, .to = 0.4}), 0.04, 6e-3);
  EXPECT_NEAR(is("crossing_period_discharge", {.at = {}, .from = 0.08, .to = 0.25}), 6e-3, 5e-5);
  EXPECT_NEAR(is("discharged_fraction", {.at = 0.4}), 0.2 * 0.28 / run.setting.mass(), 0.01);
  EXPECT_NEAR(is("residual_fraction", {}), 1 - 0.2 * 0.28 / run.setting.mass(), 0.01);
  EXPECT_NEAR(is("floor_arrival_time", {}), 0.15, 1e-4);
  EXPECT_NEAR(is("period_discharge", {.at = {}, .from = 0.05, .to = 0.3}), 6e-3, 5e-5);
  EXPECT_NEAR(is("weight_balance_error", {.at = 1}), 0, 1e-9);
  EXPECT_NEAR(is("floor_stress_settled", {}), run.setting.mass() * 9.8 / (width * depth), 1e-6);
  EXPECT_NEAR(is("floor_stress_error", {}), 0, 1e-9);
  EXPECT_NEAR(is("momentum_error", {}), 0, 1e-12);
  EXPECT_EQ(is("packing_max", {}), 0.7);
  EXPECT_EQ(is("packing_max", {.at = {}, .from = 0.2}), 0.6);
  EXPECT_EQ(is("surface_angle_bin", {.at = 0.5}), 10);
  EXPECT_EQ(is("stress_ratio_settled", {}), 0.6);
  EXPECT_EQ(is("stress_ratio_flow", {.at = 0.2}), 0.7);
  EXPECT_NEAR(is("mass_error", {}), 0, 1e-12);
  EXPECT_TRUE(std::isnan(is("stress_ratio_flow", {.at = 1.5}))) << "after the end";
  EXPECT_TRUE(std::isnan(is("discharged_fraction", {.at = 1.5})));
}

std::vector<std::string> names_in_summary(const HopperRun& run) {
  std::vector<std::string> names;
  for (const NamedValue& value : summary_of(run, hopper_measures())) names.push_back(value.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(Hopper, ASummaryHoldsWhatTheCaseItselfDefines) {
  HopperRun run = run_of_a_steady_flow();
  std::vector<std::string> names = names_in_summary(run);
  EXPECT_TRUE(contains(names, "discharge_rate_plateau"));
  EXPECT_TRUE(contains(names, "repose_angle_bin"));
  EXPECT_FALSE(contains(names, "particle_reynolds_max")) << "there is no air";

  run.setting.section = {{Vector3{0, 0, 0}, Vector3{0, 0, 1}}};  // a vessel in space
  EXPECT_FALSE(contains(names_in_summary(run), "repose_angle_bin")) << "a round heap is not the mean of its sections";
  run.setting.section.clear();

  run.setting.has_floor = false;  // what flows out is gone
  names = names_in_summary(run);
  EXPECT_TRUE(contains(names, "residual_fraction"));
  EXPECT_FALSE(contains(names, "repose_angle_bin"));
  EXPECT_FALSE(contains(names, "floor_arrival_time"));

  run.setting.shape.outlet.reset();
  run.setting.has_floor = true;
  run.setting.level_ground = false;
  names = names_in_summary(run);
  EXPECT_FALSE(contains(names, "discharge_rate_plateau"));
  EXPECT_FALSE(contains(names, "floor_stress_settled"));
  EXPECT_TRUE(contains(names, "repose_angle_bin")) << "a box without an outlet is a bin";
}

/// 0.2 kg/s between 0.02 and 0.3 s: a tenth has passed after some 28 ms, half after 140 ms, but for the bump and the
/// ripple.
TEST(Hopper, TheTimeWhileItFlowsIsTheRunsOwn) {
  const HopperRun run = run_of_a_steady_flow();
  for (const NamedValue& value : summary_of(run, hopper_measures()))
    EXPECT_TRUE(value.name != "discharge_rate_plateau" || std::abs(value.value - 0.2) < 2e-3) << value.value;
}

TEST(Hopper, TheGatesTime) {
  Series series{.names = {"time", "gate_time"}, .units = {"s", "s"}, .columns = {{0, 1, 2, 3}, {-1, -1, 1.5, 1.5}}};
  EXPECT_EQ(gate_time_of(series), 1.5);
  series.columns[1].assign(4, -1);
  EXPECT_EQ(gate_time_of(series), 3) << "it never opened";
}

TEST(Hopper, EachOfSeveralOutletsHasItsQuantities) {
  HopperRun run{.setting = setting(), .series = {}, .gate_time = 0.1};
  run.setting.outlets = {{.name = "west", .hand_discharge = 0.25, .across = 0.01}, {.name = "east", .across = 0.02}};
  run.series.names = {"time", "discharge_rate_west", "discharge_rate_east"};
  run.series.units = {"s", "kg/s", "kg/s"};
  run.series.columns = {{0, 0.1, 0.2, 0.3, 0.4}, {0, 0, 0.2, 0.2, 0.2}, {0, 0, 0.1, 0.1, 0.1}};
  const auto value = [&](const std::vector<NamedValue>& of, const std::string& name) {
    const auto found = std::find_if(of.begin(), of.end(), [&](const NamedValue& v) { return v.name == name; });
    return found != of.end() ? found->value : no_value;
  };
  const auto steady = outlet_quantities(run, 0.1, 0.3);
  EXPECT_NEAR(value(steady, "discharge_rate_west"), 0.2, 1e-12);
  EXPECT_NEAR(value(steady, "discharge_rate_east"), 0.1, 1e-12);
  EXPECT_NEAR(value(steady, "discharged_mass_west"), 0.05, 1e-12);
  EXPECT_EQ(value(steady, "discharge_rate_beverloo_west"), 0.25);
  EXPECT_TRUE(std::isnan(value(steady, "discharge_rate_beverloo_east")));
  EXPECT_NEAR(value(steady, "particles_across_east"), 0.02 / run.setting.shape.spacing, 1e-12);
  EXPECT_NEAR(value(steady, "grains_across_west"), 0.01 / run.setting.grain_diameter, 1e-9);
  const auto unsteady = outlet_quantities(run, no_value, no_value);
  EXPECT_TRUE(std::isnan(value(unsteady, "discharge_rate_west")));
  EXPECT_NEAR(value(unsteady, "discharged_mass_east"), 0.025, 1e-12);
  run.setting.outlets[0].gate = {.opens_after = 0, .closes_after = 0.2, .repeats_every = {}};
  run.setting.outlets[1].gate = {.opens_after = 0, .closes_after = 0.1, .repeats_every = {}};
  const auto closing = outlet_quantities(run, 0.1, 0.3);
  EXPECT_NEAR(value(closing, "discharge_rate_west"), 0.4, 1e-12) << "what passed, while it was open";
  EXPECT_TRUE(std::isnan(value(closing, "discharge_rate_east")));
}

}  // namespace
}  // namespace talus
