// SPDX-License-Identifier: Apache-2.0
/// The answers about a vessel, of runs made by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "analysis/hopper_estimators.hpp"
#include "analysis/particles.hpp"

namespace talus {
namespace {

constexpr double h = 5e-3, width = 0.1, height = 0.2, outlet = 0.1, gate = 0.1;

HopperSetting setting() {
  HopperSetting s{.shape = {width, width, height, HopperShape::Outlet{outlet, 0.04, 0.06}, h},
                  .domain = test::box(width, width, height),
                  .particle_mass = 1500 * h * h * h,
                  .particles = 4000,
                  .grain_density = 2500,
                  .grain_diameter = 200e-6,
                  .gravity = 10};
  s.section = {{Vector3{0, 0, 0}, Vector3{0, 0, height}}};
  s.outlet_length = 0.02;
  s.bands = {{"wall_1", 0, 0.1, 0.15, 2e-3, 0}, {"wall_2", 0, 0.15, 0.2, 2e-3, 0}, {"floor", 1, 0.1, 0.1, 1e-2, 1}};
  return s;
}

test::GrainColumns bed(double time) {
  return {test::lattice(width, width, outlet, outlet + 0.075, h), 1500, 2500, time};
}

TEST(HopperVessel, TheShareThatMovesIsAgainstTheMeanAboveTheOutlet) {
  test::GrainColumns now = bed(gate + 0.2), before = bed(gate + 0.18);
  double middle = 0;
  for (std::size_t i = 0; i < now.position.size(); ++i)
    if (std::abs(now.position[i].x - 0.5 * width) < 0.02) before.position[i].z += 1e-3, ++middle;
  const HopperSetting s = setting();
  HopperSnapshot snapshot(s, now.view(), gate);
  EXPECT_TRUE(std::isnan(hopper::share_that_moves(snapshot)));
  const Snapshot earlier = before.view();
  snapshot.before = [&] { return &earlier; };
  EXPECT_NEAR(hopper::share_that_moves(snapshot), middle / double(now.position.size()), 1e-12);
  for (Vector3& x : before.position) x.z += 0.5e-3;
  EXPECT_EQ(hopper::share_that_moves(snapshot), 1) << "also what is slow, but not ten times slower than the mean";
}

/// 0.1 s at rest, then 2 kg/s for 0.3 s; the walls bear 600 Pa across, the bed 1000 Pa, all walls 4 N.
/// \param settled_at when the first snapshot is, from the opening of the gate, s \param loaded_from when the walls
/// begin to bear the bed, s
HopperRun run(double settled_at = 0, double loaded_from = 0) {
  HopperRun run{.setting = setting(),
                .series = {.names = {"time", "gate_time", "discharge_rate", "discharged_mass", "normal_impulse_wall_1",
                                     "normal_impulse_wall_2", "impulse_wall_x", "impulse_wall_y", "impulse_wall_z"},
                           .units = std::vector<std::string>(9, "1"),
                           .columns = std::vector<std::vector<double>>(9)},
                .gate_time = gate};
  for (int n = 0; n <= 400; ++n) {
    const double t = 1e-3 * n, flowing = t >= gate ? 2 : 0;
    const double row[] = {t,
                          t < gate ? -1 : gate,
                          flowing,
                          flowing * (t - gate),
                          600 * 2e-3 * t,
                          300 * 2e-3 * t,
                          0,
                          0,
                          -4 * std::max(0.0, t - loaded_from)};
    for (std::size_t c = 0; c < 9; ++c) run.series.columns[c].push_back(row[c]);
  }
  run.snapshots = HopperRun::Numbers::of(
      {settled_at, 0.1},
      [settled_at](std::size_t n) {
        struct Held {
          HopperSetting setting;
          test::GrainColumns columns;
          HopperSnapshot snapshot;
          explicit Held(double time)
              : setting(talus::setting()), columns(bed(time)), snapshot(setting, (loaded(), columns.view()), gate) {}
          void loaded() { columns.stress_zz.assign(columns.position.size(), 1000.0); }
        };
        auto held = std::make_shared<Held>(gate + (n == 0 ? settled_at : 0.1));
        return std::shared_ptr<const HopperSnapshot>(held, &held->snapshot);
      },
      2);
  return run;
}

double value(const HopperRun& of, std::string_view name) {
  const auto* row = find_row(hopper_measures(), name);
  return row ? row->estimator.of(of, {}) : no_value;
}

TEST(HopperVessel, TheSteadyDischargeIsFoundAndGoesByTheLengthOfASlit) {
  const HopperRun of = run();
  EXPECT_NEAR(value(of, "discharge_steady"), 2, 1e-6);
  EXPECT_NEAR(value(of, "discharge_steady_per_length"), 100, 1e-4);
  const double all = of.setting.mass();
  EXPECT_NEAR(value(of, "discharge_steady_from"), 0.1 * all / 2, 1e-3) << "from a tenth discharged on";
  EXPECT_GT(value(of, "discharge_steady_to"), 0.25);
  EXPECT_NEAR(value(of, "discharge_steady_error"), 0, 1e-6);
}

/// A bed of 10 kg, (D/g)^½ = 50 ms, T = 15 ms, a hundred rows a second, of which `passed` (kg at a time) has left.
template <class Passed>
HopperRun flowing(double end, Passed&& passed) {
  HopperSetting s = setting();
  s.particle_mass = 10 / s.particles;
  s.time_scale = 0.05, s.averaging_time = 0.015;
  HopperRun run{.setting = s,
                .series = {.names = {"time", "gate_time", "discharge_rate", "discharged_mass"},
                           .units = std::vector<std::string>(4, "1"),
                           .columns = std::vector<std::vector<double>>(4)},
                .gate_time = 0};
  for (int n = 0; 1e-3 * n <= end + 1e-9; ++n) {
    const double t = 1e-3 * n, rate = (passed(t + 5e-4) - passed(std::max(0.0, t - 5e-4))) / (t > 0 ? 1e-3 : 5e-4);
    const double row[] = {t, 0, rate, passed(t)};
    for (std::size_t c = 0; c < 4; ++c) run.series.columns[c].push_back(row[c]);
  }
  return run;
}

TEST(HopperVessel, TheThroughputIsWhatIsTakenAwayWhileItIsSteady) {
  HopperRun chute = flowing(1, [](double t) { return 2 * std::clamp(t - 0.2, 0.0, 0.5); });
  chute.series.names[3] = "removed_mass";
  const auto* row = find_row(hopper_measures(), "throughput");
  ASSERT_NE(row, nullptr);
  EXPECT_FALSE(row->in_summary.applies(chute)) << "an outlet has discharge_steady";
  chute.setting.shape.outlet = std::nullopt;
  EXPECT_TRUE(row->in_summary.applies(chute));
  EXPECT_NEAR(value(chute, "throughput"), 2, 1e-6);
  EXPECT_NEAR(value(chute, "throughput_error"), 0, 1e-6);
  std::fill(chute.series.columns[3].begin(), chute.series.columns[3].end(), 0.0);
  EXPECT_FALSE(row->in_summary.applies(chute)) << "nothing is taken away";
}

TEST(FlowEnd, AJamIsNoFlow) {
  // 0.2 % leaves within 10 ms, at 2 kg/s; then an arch stands.
  const HopperRun jam = flowing(2, [](double t) { return std::min(2 * t, 0.02); });
  const hopper::FlowEnd end = hopper::flow_end(jam);
  EXPECT_EQ(end.state, hopper::FlowState::has_stopped);
  EXPECT_NEAR(end.stop_time, 0.01, 2e-3);
  EXPECT_NEAR(end.left, 9.98, 1e-9);
  EXPECT_NEAR(end.discharged, 0.002, 1e-12);
  EXPECT_TRUE(std::isnan(value(jam, "discharge_steady"))) << "no steady rate of 0.2 %";
  EXPECT_TRUE(std::isnan(value(jam, "share_that_moves"))) << "no regime of 0.2 %";
}

TEST(FlowEnd, NothingThatPassedHasNotStarted) {
  const HopperRun shut = flowing(2, [](double) { return 0.0; });
  EXPECT_EQ(hopper::flow_end(shut).state, hopper::FlowState::has_not_started);
  EXPECT_NEAR(value(shut, "residual_mass"), 10, 1e-9);
  EXPECT_TRUE(std::isnan(value(shut, "flow_stop_time")));
  EXPECT_TRUE(std::isnan(value(shut, "discharge_steady")));
}

TEST(FlowEnd, ASiloEmptiesOrIsLeftWithARest) {
  const HopperRun emptied = flowing(3, [](double t) { return std::min(5 * t, 9.95); });
  EXPECT_EQ(hopper::flow_end(emptied).state, hopper::FlowState::has_emptied);
  EXPECT_NEAR(value(emptied, "emptying_time"), 9.9 / 5, 2e-3);
  EXPECT_NEAR(value(emptied, "discharge_steady"), 5, 0.01);
  EXPECT_LE(value(emptied, "discharge_steady_to"), 7.0 / 5 + 1e-9) << "not the last third";
  const HopperRun rest = flowing(3, [](double t) { return std::min(5 * t, 6.0); });
  EXPECT_EQ(hopper::flow_end(rest).state, hopper::FlowState::has_stopped);
  EXPECT_NEAR(hopper::flow_end(rest).stop_time, 1.2, 0.01);
  EXPECT_NEAR(hopper::flow_end(rest).left, 4, 1e-9);
}

TEST(FlowEnd, AFlowThatGoesOnOrHasHardlyRestedHasNotStopped) {
  const HopperRun flows = flowing(1, [](double t) { return 5 * t; });
  EXPECT_EQ(hopper::flow_end(flows).state, hopper::FlowState::flows);
  EXPECT_TRUE(std::isnan(hopper::flow_end(flows).stop_time));
  const HopperRun pause = flowing(1, [](double t) { return std::min(5 * t, 4.5); });  // 0.1 s of rest, two (D/g)^½
  EXPECT_EQ(hopper::flow_end(pause).state, hopper::FlowState::flows);
}

TEST(FlowEnd, TheEstimateSaysWhatATrickleIs) {
  HopperRun trickle = flowing(2, [](double t) { return std::min(0.01 * t, 0.001 * t + 0.005); });
  EXPECT_EQ(hopper::flow_end(trickle).state, hopper::FlowState::flows);
  trickle.setting.hand_discharge = 5;
  EXPECT_NE(hopper::flow_end(trickle).state, hopper::FlowState::flows) << "a five hundredth of the estimate";
}

TEST(SteadyDischarge, OfATrendIsItsMeanWhereItIsLevel) {
  // Falls from 5 to 4 kg/s while the bed leaves: all within 10 % of the mean of the stretch, or less of it.
  const HopperRun trend = flowing(2.2, [](double t) { return 5 * t - 0.25 * t * t; });
  const double from = value(trend, "discharge_steady_from"), to = value(trend, "discharge_steady_to");
  EXPECT_NEAR(value(trend, "discharge_steady"), 5 - 0.25 * (from + to), 0.02);
  EXPECT_FALSE(value(trend, "discharge_steady_error") < 0.05) << "the trend is in the error";
  EXPECT_TRUE(std::isnan(value(flowing(0.3, [](double t) { return 5 * t; }), "discharge_steady_error")))
      << "too short for one";
}

TEST(HopperVessel, AnArchIsThePackingAboveTheOutlet) {
  HopperSetting s = setting();
  s.outlet_width = 0.02, s.outlet_depth = 0.02, s.middle = 0.5 * width;
  test::GrainColumns now = bed(gate + 0.2);
  EXPECT_NEAR(hopper::outlet_packing(HopperSnapshot(s, now.view(), gate)), 0.6, 0.25);
  std::erase_if(now.position, [](const Vector3& x) { return std::abs(x.x - 0.5 * width) < 0.02; });
  const Snapshot places{.time = 1, .columns = {{"position", "m", std::span<const Vector3>(now.position)}}};
  EXPECT_EQ(hopper::outlet_packing(HopperSnapshot(s, places, gate)), 0);
}

TEST(HopperVessel, PlanesOfSymmetryThroughTheOutletLeaveItsPackingAsItIs) {
  HopperSetting s = setting();
  s.outlet_width = 0.02, s.outlet_depth = 0.02, s.middle = 0.5 * width;
  const test::GrainColumns now = bed(gate + 0.2);
  const double whole = hopper::outlet_packing(HopperSnapshot(s, now.view(), gate));
  std::vector<Vector3> quarter;
  for (const Vector3& x : now.position)
    if (x.x >= 0.5 * width && x.y >= 0.5 * width) quarter.push_back(x);
  Box box = s.domain.box();
  box.low.x = box.low.y = 0.5 * width;
  s.domain = Domain(box);
  const Snapshot places{.time = 1, .columns = {{"position", "m", std::span<const Vector3>(quarter)}}};
  EXPECT_NEAR(hopper::outlet_packing(HopperSnapshot(s, places, gate)), whole, 1e-9);
}

TEST(HopperVessel, TheRatioOfPressuresIsUnknownWhereNoSnapshotHasTheSettledBed) {
  EXPECT_TRUE(std::isfinite(hopper::wall_pressure_ratio(run(-0.05), {})));
  EXPECT_TRUE(std::isnan(hopper::wall_pressure_ratio(run(-0.05, gate - 0.04), {}))) << "it bears nothing yet";
}

TEST(HopperVessel, ABedThatNoWallBearsFallsAndHasNoTop) {
  EXPECT_TRUE(std::isnan(hopper::settled_top(run(0, 1))));
  EXPECT_FALSE(std::isnan(hopper::settled_top(run(0, 0.1)))) << "borne as the gate opens";
}

TEST(HopperVessel, TheRatioOfPressuresIsOfTheBandsThatTheBedFills) {
  const HopperRun of = run();
  EXPECT_NEAR(hopper::settled_top(of), 0.175, 1e-9);
  EXPECT_NEAR(hopper::wall_pressure_ratio(of, {}), 0.6, 1e-9) << "the upper band is half empty";
  HopperRun beside = run();
  beside.setting.bands.push_back(beside.setting.bands.front());
  beside.setting.bands.back().name = "of another bin", beside.setting.bands.back().is_bare = true;
  EXPECT_NEAR(hopper::wall_pressure_ratio(beside, {}), 0.6, 1e-9) << "no grain has touched it";
  EXPECT_NEAR(value(of, "weight_balance_error_at_rest"), 4 / (4000 * 1500 * h * h * h * 10) - 1, 1e-9);
}

}  // namespace
}  // namespace talus
