// SPDX-License-Identifier: Apache-2.0
/// The answers about a vessel, of runs made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "analysis/hopper_estimators.hpp"
#include "analysis/particles.hpp"

namespace talus {
namespace {

constexpr double h = 5e-3, width = 0.1, height = 0.2, outlet = 0.1, gate = 0.1;

HopperSetting setting() {
  HopperSetting s{.shape = {width, width, height, HopperShape::Plate{outlet, 0.04, 0.06}, h},
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
  EXPECT_TRUE(std::isnan(hopper::share_that_moves(snapshot, {})));
  const Snapshot earlier = before.view();
  snapshot.before = [&] { return &earlier; };
  EXPECT_NEAR(hopper::share_that_moves(snapshot, {}), middle / double(now.position.size()), 1e-12);
  for (Vector3& x : before.position) x.z += 0.5e-3;
  EXPECT_EQ(hopper::share_that_moves(snapshot, {}), 1) << "also what is slow, but not ten times slower than the mean";
}

/// 0.1 s at rest, then 2 kg/s for 0.3 s; the walls bear 600 Pa across, the bed 1000 Pa, all walls 4 N.
HopperRun run() {
  HopperRun run{.setting = setting(),
                .series = {.names = {"time", "gate_time", "discharge_rate", "discharged_mass", "normal_impulse_wall_1",
                                     "normal_impulse_wall_2", "impulse_wall_x", "impulse_wall_y", "impulse_wall_z"},
                           .units = std::vector<std::string>(9, "1"),
                           .columns = std::vector<std::vector<double>>(9)},
                .gate_time = gate};
  for (int n = 0; n <= 400; ++n) {
    const double t = 1e-3 * n, flowing = t >= gate ? 2 : 0;
    const double row[] = {
        t, t < gate ? -1 : gate, flowing, flowing * (t - gate), 600 * 2e-3 * t, 300 * 2e-3 * t, 0, 0, -4 * t};
    for (std::size_t c = 0; c < 9; ++c) run.series.columns[c].push_back(row[c]);
  }
  run.snapshots = HopperRun::Numbers::of(
      {0, 0.1},
      [](std::size_t n) {
        struct Held {
          HopperSetting setting;
          test::GrainColumns columns;
          HopperSnapshot snapshot;
          explicit Held(double time)
              : setting(talus::setting()), columns(bed(time)), snapshot(setting, (loaded(), columns.view()), gate) {}
          void loaded() { columns.stress_zz.assign(columns.position.size(), 1000.0); }
        };
        auto held = std::make_shared<Held>(gate + (n == 0 ? 0 : 0.1));
        return std::shared_ptr<const HopperSnapshot>(held, &held->snapshot);
      },
      2);
  return run;
}

double value(const HopperRun& of, std::string_view name) {
  const auto* row = find_row(hopper_measures(), name);
  return row ? row->estimator.of(of, {}, {}) : HopperRun::none;
}

TEST(HopperVessel, TheSteadyDischargeIsFoundAndGoesByTheLengthOfASlit) {
  const HopperRun of = run();
  EXPECT_NEAR(value(of, "discharge_steady"), 2, 1e-6);
  EXPECT_NEAR(value(of, "discharge_steady_per_length"), 100, 1e-4);
  EXPECT_NEAR(value(of, "discharge_steady_to") - value(of, "discharge_steady_from"), 0.3, 0.021);
  EXPECT_NEAR(value(of, "discharge_steady_error"), 0, 0.05);
}

TEST(HopperVessel, TheRatioOfPressuresIsOfTheBandsThatTheBedFills) {
  const HopperRun of = run();
  EXPECT_NEAR(hopper::settled_top(of), 0.175, 1e-9);
  EXPECT_NEAR(hopper::wall_pressure_ratio(of, {}, {}), 0.6, 1e-9) << "the upper band is half empty";
  EXPECT_NEAR(value(of, "weight_balance_error_at_rest"), 4 / (4000 * 1500 * h * h * h * 10) - 1, 1e-9);
}

}  // namespace
}  // namespace talus
