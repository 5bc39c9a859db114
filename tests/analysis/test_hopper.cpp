// SPDX-License-Identifier: Apache-2.0
/// A run from a hopper made by hand, whose numbers are known.
#include "analysis/hopper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>

#include "analysis/hopper_numbers.hpp"
#include "analysis/particles.hpp"
#include "analysis/row_values.hpp"

namespace talus {
namespace {

using std::numbers::pi;

// The paper's box: 100 x 5 x 250 mm, the plate at 100 mm, its slit from 30 to 70 mm; h = 5/3 mm.
constexpr double width = 0.1, depth = 5e-3, height = 0.25, plate = 0.1, h = 5e-3 / 3;
constexpr double grain_density = 2500, bulk_density = 1500;
constexpr double particle_mass = bulk_density * h * h * h;
constexpr double gate = 0.25;  // s, in the run's time

HopperSetting setting() {
  return {.shape = {width, depth, height, HopperShape::Plate{plate, 0.03, 0.07}, h},
          .domain = test::box(width, depth, height, {test::plate(width, plate, 0.03, 0.07)}),
          .particle_mass = particle_mass,
          .particles = 9000,
          .grain_density = grain_density,
          .grain_diameter = 200e-6,
          .gravity = 9.8};
}

/// The end as it might be: two wedges of 30 degrees left in the hopper, a roof of 25 degrees in the bin.
std::vector<Vector3> heaps() {
  const double steep = std::tan(pi / 6), gentle = std::tan(25 * pi / 180);
  auto points = test::lattice(width, depth, 0, plate, h,
                              [&](double x, double z) { return z < 0.03 + gentle * (0.05 - std::abs(x - 0.05)); });
  const auto above = test::lattice(width, depth, plate, height, h,
                                   [&](double x, double z) { return z - plate < steep * (std::abs(x - 0.05) - 0.02); });
  points.insert(points.end(), above.begin(), above.end());
  return points;
}

TEST(Hopper, FrameOfTwoHeaps) {
  test::GrainColumns now(heaps(), bulk_density, grain_density, gate + 1);
  test::GrainColumns before = now;
  before.time -= 0.02;
  for (Vector3& x : before.position) x.x += 2e-6;  // 0.1 mm/s
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    now.stress_zz[i] = 600;
    now.stress_xx[i] = now.stress_yy[i] = 400;
  }
  now.density.assign(now.density.size(), 1.02 * bulk_density);
  const HopperSetting paper = setting();
  HopperSnapshot snapshot(paper, now.view(), gate);
  EXPECT_TRUE(std::isnan(hopper::quiescent_speed(snapshot, {}))) << "there is no snapshot before";
  const Snapshot earlier = before.view();
  snapshot.before = [&] { return &earlier; };
  const auto is = [&](HopperRun::Numbers::Number number, const Place& place = {}) { return number(snapshot, place); };
  EXPECT_NEAR(snapshot.time, 1, 1e-12);
  EXPECT_NEAR(is(hopper::repose_angle_in<hopper::Where::bin, &ReposeAngle::mean>), 25, 1);
  EXPECT_NEAR(is(hopper::repose_angle_in<hopper::Where::bin, &ReposeAngle::steepest>), 25, 1.5);
  EXPECT_NEAR(is(hopper::repose_angle_in<hopper::Where::hopper, &ReposeAngle::mean>), 30, 1);
  EXPECT_NEAR(is(hopper::surface_angle_in<hopper::Where::hopper>), 30, 1);
  EXPECT_NEAR(is(hopper::surface_angle_in<hopper::Where::bin>), 25, 1);
  EXPECT_NEAR(is(hopper::surface_height_in<hopper::Where::bin>, {{"from", 0.02}, {"to", 0.03}}),
              0.03 + 0.025 * std::tan(25 * pi / 180), 0.3e-3);
  EXPECT_NEAR(is(hopper::surface_height_in<hopper::Where::hopper>, {{"from", 0.035}, {"to", 0.045}}),
              plate + 0.02 * std::tan(pi / 6), 0.5e-3);
  EXPECT_NEAR(is(hopper::surface_outward_angle_in<hopper::Where::bin>, {{"from", 0.01}, {"to", 0.045}}), 25, 1);
  EXPECT_NEAR(is(hopper::foot_reach, {{"height", 5e-3}}), 0.05, 1e-12) << "to the walls";
  EXPECT_NEAR(is(hopper::quiescent_speed), 1e-4, 1e-12);
  EXPECT_NEAR(is(hopper::stress_ratio), 2.0 / 3, 1e-12);
  EXPECT_EQ(is(hopper::inertial_share), 1);
  EXPECT_NEAR(is(hopper::density_drift), 0.02, 1e-12);
  EXPECT_NEAR(is(hopper::packing_max), 0.6, 1e-12);
  EXPECT_NEAR(is(hopper::left_right_imbalance), 0, 1e-12);
  EXPECT_NEAR(is(hopper::corner_packing_ratio_in<hopper::Where::bin>, {{"size", 0.01}}), 1, 0.01);
  EXPECT_EQ(is(hopper::gradient<&GradientSizes::shear_max>), 0);
  EXPECT_TRUE(std::isnan(is(hopper::stream_packing, {{"from", 0.04}, {"to", 0.09}, {"free", 0.04}})))
      << "the heap has grown into it";
  EXPECT_DOUBLE_EQ(is(hopper::mass), particle_mass * double(now.position.size()));
  EXPECT_THROW(is(hopper::corner_packing_ratio_in<hopper::Where::bin>), std::out_of_range) << "it needs a size";
}

TEST(Hopper, ASnapshotWithoutParticlesHasNoNumbers) {
  const test::GrainColumns none({}, bulk_density, grain_density, gate + 1);
  const HopperSetting paper = setting();
  const HopperSnapshot snapshot(paper, none.view(), gate);
  for (const auto& m : columns_of_snapshots(hopper_measures()))
    EXPECT_TRUE(m.name == "mass" || m.name == "left_right_imbalance" || std::isnan(m.estimator.number(snapshot, {})))
        << m.name;
  EXPECT_EQ(hopper::mass(snapshot, {}), 0);
}

/// A full hopper over an empty bin with a stream of half the slit's width, that narrows to a quarter half-way down.
TEST(Hopper, FrameOfAStream) {
  auto points = test::lattice(width, depth, plate, plate + 50 * h, h);
  const std::size_t bed = points.size();
  const auto stream = test::lattice(width, depth, 30e-3, 60 * h, h,
                                    [&](double x, double z) { return std::abs(x - 0.05) < (z > 0.075 ? 10 : 5) * h; });
  points.insert(points.end(), stream.begin(), stream.end());
  test::GrainColumns now(points, bulk_density, grain_density, gate + 0.2);
  for (std::size_t i = bed; i < points.size(); ++i) now.packing[i] = 0.4;
  for (std::size_t i = 0; i < points.size(); ++i) now.velocity[i].z = i < bed ? -0.2 : -1;
  for (std::size_t i = 0; i < points.size(); ++i) now.stress_zz[i] = i < bed ? 500 : 50;
  now.packing[bed - 1] = 0.9;  // one particle is no percentile
  const HopperSetting paper = setting();
  const HopperSnapshot snapshot(paper, now.view(), gate);
  const auto is = [&](HopperRun::Numbers::Number number, const Place& place = {}) { return number(snapshot, place); };
  const Place across{{"height", 0.12}, {"left", 0.03}, {"right", 0.07}};
  EXPECT_NEAR(is(hopper::stream_width, {{"from", 0.04}, {"to", 0.06}, {"free", 0.04}}) /
                  is(hopper::stream_width, {{"from", 0.09}, {"to", 0.1}, {"free", 0.04}}),
              0.5, 0.1);
  const Place below{{"from", 0.04}, {"to", 0.09}, {"free", 0.04}};
  EXPECT_NEAR(is(hopper::stream_packing, below), 0.4, 1e-12);
  const double of_cells = is(hopper::stream_packing_of_cells, below);
  EXPECT_LT(of_cells, 0.59) << "cells at the edges are not full";
  EXPECT_GT(of_cells, 0.45);
  EXPECT_NEAR(is(hopper::stream_stress_share, {{"from", 0.04}, {"to", 0.09}, {"free", 0.04}}), 0.1, 1e-12);
  EXPECT_LT(is(hopper::stream_stripes, {{"from", 0.04}, {"to", 0.095}, {"free", 0.04}}), 0.02);
  EXPECT_NEAR(is(hopper::hopper_velocity, across), -0.2, 1e-9);
  EXPECT_NEAR(is(hopper::hopper_packing, across), 0.6, 0.012);
  EXPECT_NEAR(is(hopper::packing_max), 0.6, 1e-12);
  EXPECT_NEAR(is(hopper::surface_angle_in<hopper::Where::hopper>), 0, 0.01);
  EXPECT_TRUE(std::isnan(is(hopper::repose_angle_in<hopper::Where::hopper, &ReposeAngle::mean>)));
  EXPECT_NEAR(is(hopper::surface_swelling, {{"beside", 0.02}, {"width", 0.004}}), 0, 1e-9);
  EXPECT_EQ(is(hopper::inertial_share), 1) << "nothing shears";
  EXPECT_NEAR(is(hopper::inertial_share_of_bearing_in_shear), 1, 0.01) << "but where the bed passes into the stream";
}

/// A layer on the floor that has come farther on the right than on the left, and falling grains above the floor at the
/// wall; then with nothing on the left.
TEST(Hopper, FrameOfAFoot) {
  const auto layer = [](double left, double right) {
    auto points =
        test::lattice(width, depth, 0, 6 * h, h, [=](double x, double) { return x > 0.05 - left && x < 0.05 + right; });
    const auto drops = test::lattice(width, depth, 12 * h, 18 * h, h, [](double x, double) { return x > 0.09; });
    points.insert(points.end(), drops.begin(), drops.end());
    return test::GrainColumns(points, bulk_density, grain_density, gate + 0.16);
  };
  const HopperSetting paper = setting();
  const test::GrainColumns both = layer(12 * h, 18 * h), right = layer(0, 18 * h);
  EXPECT_NEAR(hopper::foot_reach(HopperSnapshot(paper, both.view(), gate), {{"height", 5e-3}}), 15 * h, 0.4 * h);
  EXPECT_TRUE(std::isnan(hopper::foot_reach(HopperSnapshot(paper, right.view(), gate), {{"height", 5e-3}})));
}

/// Where grains may be: above the plate, beside the slit below it, in the stream; slow, fast and free ones.
TEST(Hopper, TheShareOfSlowFlow) {
  struct Grain {
    Vector3 position;
    double pressure, shear_rate;
  };
  constexpr double slow = 0, fast = 1000;  // 1/s: I = 0.2 at 2500 Pa
  constexpr double above = plate + 0.02, below = plate - 0.02, beside = 0.01, middle = 0.05;
  const std::vector<Grain> grains = {{{beside, 0, above}, 2500, slow}, {{middle, 0, above}, 2500, slow},
                                     {{middle, 0, above}, 2500, fast}, {{middle, 0, above}, 0, slow},
                                     {{beside, 0, below}, 2500, slow}, {{beside, 0, below}, 0, slow},
                                     {{middle, 0, below}, 2500, fast}, {{middle, 0, below}, 2500, slow}};
  test::GrainColumns now(std::vector<Vector3>(grains.size()), bulk_density, grain_density, gate + 0.2);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    now.position[i] = grains[i].position;
    now.stress_xx[i] = now.stress_yy[i] = now.stress_zz[i] = grains[i].pressure;
    now.shear_rate[i] = grains[i].shear_rate;
  }
  const HopperSetting paper = setting();
  const HopperSnapshot snapshot(paper, now.view(), gate);
  EXPECT_DOUBLE_EQ(hopper::inertial_share(snapshot, {}), 2.0 / 4)
      << "above the outlet; those that bear nothing as fast";
  EXPECT_DOUBLE_EQ(hopper::inertial_share_of_bearing(snapshot, {}), 3.0 / 4)
      << "those that bear a pressure and are not below the outlet, beside it too";
  HopperSetting box = setting();
  box.shape.plate.reset();
  const HopperSnapshot whole(box, now.view(), gate);
  EXPECT_DOUBLE_EQ(hopper::inertial_share(whole, {}), 4.0 / 8) << "without an outlet, of all";
  EXPECT_DOUBLE_EQ(hopper::inertial_share_of_bearing(whole, {}), 4.0 / 6);
}

/// Numbers of 21 snapshots, one every 50 ms.
double number_by_hand(std::size_t snapshot, HopperRun::Numbers::Number number, const Place& place) {
  const auto n = static_cast<int>(snapshot);
  const std::map<HopperRun::Numbers::Number, double> numbers = {
      {hopper::surface_angle_in<hopper::Where::hopper>, n < 2     ? 0.5
                                                        : n == 10 ? 12
                                                                  : std::min(30, 3 * n)},
      {hopper::surface_angle_in<hopper::Where::bin>, n},
      {hopper::packing_max, n == 3 ? 0.7 : 0.6},
      {hopper::repose_angle_in<hopper::Where::bin, &ReposeAngle::mean>, 28},
      {hopper::repose_angle_in<hopper::Where::hopper, &ReposeAngle::mean>, 33},
      {hopper::stream_width, place.contains("from") && place.at("from") > 0.05 ? 0.04
                             : n == 5                                          ? 0.02
                                                                               : 0.03},
      {hopper::stress_ratio, n == 0 ? 0.6 : 0.7},
      {hopper::foot_reach, n < 4   ? HopperRun::none
                           : n < 6 ? 0.02
                                   : std::min(0.05, 0.02 + 4e-3 * (n - 6))},
      {hopper::mass, setting().mass()}};
  const auto found = numbers.find(number);
  return found == numbers.end() ? HopperRun::none : found->second;
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
  column("probe_density", [&](double t) { return 1400 + std::sin(2 * pi * t / 0.0066); });
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

double measure(std::string_view name, const HopperRun& run, const Window& window, const Place& place = {}) {
  return find_row(hopper_measures(), name)->estimator.of(run, place, window);
}

TEST(Hopper, QuantitiesOfARun) {
  const HopperRun run = run_of_a_steady_flow();
  const auto is = [&](std::string_view name, const Window& window) { return measure(name, run, window); };
  const Window plateau{.at = {}, .from = 0.05, .to = 0.2}, early{.at = {}, .from = 0, .to = 0.1};
  EXPECT_NEAR(is("discharge_rate_plateau", plateau), 0.2, 2e-4);
  EXPECT_NEAR(is("discharge_rate_drift", plateau), 0, 0.01);
  EXPECT_NEAR(is("discharge_rate_fall", {.at = {}, .from = 0.3, .to = 0.4}), -0.2, 2e-3);
  EXPECT_NEAR(is("discharge_rate_extreme_time", early), 0.04, 3e-4) << "means over a period do not swing";
  EXPECT_NEAR(is("slit_velocity_extreme_time", early), 0.03, 3e-4);
  EXPECT_NEAR(is("discharge_rate_max", {.at = {}, .from = 0.03, .to = 0.4}), 0.2 + 0.05 * 3e-3 * std::sqrt(pi) / 0.02,
              0.004);
  EXPECT_NEAR(is("discharge_rate_max_time", {.at = {}, .from = 0.03, .to = 0.4}), 0.04, 6e-3);
  EXPECT_NEAR(is("discharge_rate_share_of_largest", {.at = {}, .from = 0.1, .to = 0.12}),
              0.2 / is("discharge_rate_max", {.at = {}, .from = 0, .to = 0.4}), 4e-3);
  EXPECT_NEAR(is("crossing_period_discharge", {.at = {}, .from = 0.08, .to = 0.25}), 6e-3, 5e-5);
  EXPECT_NEAR(is("crossing_period_density", {.at = {}, .from = 0.05, .to = 0.3}), 6.6e-3, 5e-5);
  EXPECT_TRUE(std::isnan(is("crossing_period_strain", {.at = {}, .from = 0.05, .to = 0.3})));
  EXPECT_NEAR(is("discharged_fraction", {.at = 0.4}), 0.2 * 0.28 / run.setting.mass(), 0.01);
  EXPECT_NEAR(is("residual_fraction", {}), 1 - 0.2 * 0.28 / run.setting.mass(), 0.01);
  EXPECT_NEAR(measure("floor_arrival_first_time", run, {}, {{"height", 1e-3}}), std::sqrt(0.099 / 4.9), 1e-5);
  EXPECT_NEAR(is("floor_arrival_time", {}), 0.15, 1e-4);
  EXPECT_NEAR(is("period_discharge", {.at = {}, .from = 0.05, .to = 0.3}), 6e-3, 5e-5);
  EXPECT_NEAR(is("period_density", {.at = {}, .from = 0.05, .to = 0.3}), 6.6e-3, 5e-5);
  EXPECT_TRUE(std::isnan(is("period_strain", {.at = {}, .from = 0.05, .to = 0.3}))) << "there is no such column";
  EXPECT_NEAR(is("weight_balance_error", {.at = 1}), 0, 1e-9);
  EXPECT_NEAR(is("floor_stress_settled", {}), run.setting.mass() * 9.8 / (width * depth), 1e-6);
  EXPECT_NEAR(is("floor_stress_error", {}), 0, 1e-9);
  EXPECT_NEAR(is("momentum_error", {}), 0, 1e-12);
  EXPECT_EQ(is("packing_max", {}), 0.7);
  EXPECT_EQ(is("packing_max", {.at = {}, .from = 0.2}), 0.6);
  EXPECT_EQ(is("surface_angle_bin", {.at = 0.5}), 10);
  EXPECT_NEAR(is("surface_angle_largest_fall", {}), 27 - 12, 1e-12);
  EXPECT_NEAR(is("surface_angle_end_difference", {}), -3, 1e-12);
  EXPECT_EQ(is("repose_angle_nearer", {}), 28);
  EXPECT_EQ(is("repose_angle_other", {}), 33);
  EXPECT_NEAR(measure("stream_narrowing", run, {.at = {}, .from = 0.2, .to = 0.3},
                      {{"above_from", 0.09}, {"above_to", 0.1}, {"below_from", 0.04}, {"below_to", 0.06}}),
              0.025 / 0.04, 1e-12);
  EXPECT_EQ(is("stress_ratio_settled", {}), 0.6);
  EXPECT_EQ(is("stress_ratio_flow", {.at = 0.2}), 0.7);
  const Place floor{{"height", 5e-3}, {"from", 0.0239}, {"to", 0.0451}};
  EXPECT_NEAR(measure("foot_speed", run, {}, floor), 4e-3 / 0.05, 1e-12);
  EXPECT_TRUE(std::isnan(measure("foot_speed", run, {.at = {}, .from = 0, .to = 0.41}, floor))) << "two points";
  EXPECT_NEAR(is("mass_error", {}), 0, 1e-12);
  EXPECT_TRUE(std::isnan(is("stress_ratio_flow", {.at = 1.5}))) << "after the end";
  EXPECT_TRUE(std::isnan(is("discharged_fraction", {.at = 1.5})));
}

TEST(Hopper, APeriodIsTakenAsLongAsThereAreGrains) {
  HopperRun run = run_of_a_steady_flow();
  const Window window{.at = {}, .from = 0.05, .to = 0.3};
  auto& density = run.series.columns[7];
  ASSERT_EQ(run.series.names[7], "probe_density");
  const auto empty_from = [&](double t) {
    for (std::size_t n = 0; n < density.size(); ++n)
      if (run.series.columns[0][n] - gate > t) density[n] = std::nan("");
  };
  empty_from(0.25);
  EXPECT_NEAR(measure("period_density", run, window), 6.6e-3, 1e-4);
  empty_from(0.15);
  EXPECT_TRUE(std::isnan(measure("period_density", run, window)));
}

/// A run with one and a half times the discharge, and a bin that is steeper by 5 degrees.
HopperRun faster(const HopperRun& slow) {
  HopperRun fast = slow;
  for (const std::size_t column : {2, 3})
    for (double& value : fast.series.columns[column]) value *= 1.5;
  fast.snapshots = {slow.snapshots.time(), [](std::size_t n, HopperRun::Numbers::Number number, const Place& place) {
                      return number_by_hand(n, number, place) +
                             (number == hopper::surface_angle_in<hopper::Where::bin> ? 5 : 0);
                    }};
  return fast;
}

TEST(Hopper, RowsOfTwoRuns) {
  const HopperRun slow = run_of_a_steady_flow();
  const std::vector<HopperRun> first = {faster(slow)}, second = {slow};
  const MeasuresOfModel<HopperRun> measures{hopper_measures(), hopper_pair_measures(), {}};
  const auto of = [&](std::string quantity, Statistic statistic = Statistic::mean,
                      Window window = {.at = {}, .from = 0.03, .to = 0.28}) {
    const ComparisonRow row{
        .quantity = std::move(quantity), .from = From::variants, .statistic = statistic, .window = window};
    return RowValues<HopperRun>(row, {&first, &second}, measures).values().at(0);
  };
  EXPECT_NEAR(*of("discharge_rate_max", Statistic::ratio), 1.5, 1e-9);
  EXPECT_NEAR(*of("discharge_rate_ratio_at_max"), 1.5, 1e-9);
  EXPECT_EQ(*of("discharge_rate_share_larger"), 1);
  EXPECT_NEAR(*of("slit_velocity_fluctuation", Statistic::ratio), 1, 1e-12);
  EXPECT_NEAR(*of("surface_angle_bin", Statistic::difference, {.at = 0.5}), 5, 1e-12);
  EXPECT_NEAR(*of("discharge_resolution_difference", Statistic::mean, {}),
              0.5 * (0.2 * 0.28 + 1.5 * 0.02 * 0.006 / (2 * pi) + 0.05 * 3e-3 * std::sqrt(pi)) / slow.setting.mass(),
              1e-6)
      << "the ripple ends two thirds through a period";
  EXPECT_EQ(of("surface_angle_bin", Statistic::difference, {.at = 1.5}), std::nullopt) << "after the end";
  EXPECT_THROW(of("discharge_rate_max"), std::out_of_range) << "a number of one run";
}

TEST(Hopper, RowsOfTwoVariantsAreMeansOverTheirMembers) {
  const HopperRun slow = run_of_a_steady_flow();
  const std::vector<HopperRun> first = {faster(slow), slow}, second = {slow};
  const MeasuresOfModel<HopperRun> measures{hopper_measures(), hopper_pair_measures(), {}};
  const auto of = [&](std::string quantity, Statistic statistic, Window window = {.at = {}, .from = 0.03, .to = 0.28}) {
    const ComparisonRow row{
        .quantity = std::move(quantity), .from = From::variants, .statistic = statistic, .window = window};
    return *RowValues<HopperRun>(row, {&first, &second}, measures).values().at(0);
  };
  EXPECT_NEAR(of("discharge_rate_max", Statistic::ratio), 1.25, 1e-9);
  EXPECT_NEAR(of("surface_angle_bin", Statistic::difference, {.at = 0.5}), 2.5, 1e-12);
  EXPECT_NEAR(of("discharge_rate_ratio_at_max", Statistic::mean), 1.25, 1e-9);
  EXPECT_EQ(of("discharge_rate_share_larger", Statistic::mean), 0.5);
  EXPECT_NEAR(
      of("discharge_resolution_difference", Statistic::mean, {}),
      0.5 * 0.5 * (0.2 * 0.28 + 1.5 * 0.02 * 0.006 / (2 * pi) + 0.05 * 3e-3 * std::sqrt(pi)) / slow.setting.mass(),
      1e-6);
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
  for (const auto& m : hopper_measures()) EXPECT_FALSE(m.in_summary && !m.place.empty()) << m.name;
  HopperRun run = run_of_a_steady_flow();
  std::vector<std::string> names = names_in_summary(run);
  EXPECT_TRUE(contains(names, "discharge_rate_plateau"));
  EXPECT_TRUE(contains(names, "repose_angle_bin"));
  EXPECT_FALSE(contains(names, "particle_reynolds_max")) << "there is no air";
  EXPECT_FALSE(contains(names, "stream_narrowing")) << "it needs a place";

  run.setting.has_floor = false;  // what flows out is gone
  names = names_in_summary(run);
  EXPECT_TRUE(contains(names, "residual_fraction"));
  EXPECT_FALSE(contains(names, "repose_angle_bin"));
  EXPECT_FALSE(contains(names, "floor_arrival_time"));

  run.setting.shape.plate.reset();
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

}  // namespace
}  // namespace talus
