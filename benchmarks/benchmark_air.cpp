// SPDX-License-Identifier: Apache-2.0
/// A time step of the air in the hopper of Yuu & Umekage 2011: 80 x 4 x 200 cells, 9000 particles above a plate with an
/// open slit that they fall through, in steps of 100 us; and what it takes to spread the particles over the cells.
#include <benchmark/benchmark.h>

#include "models/air/flow.hpp"
#include "physics/coupling/deposition.hpp"

namespace talus::air {
namespace {

constexpr double mm = 1e-3, spacing = 5 * mm / 3;

struct Hopper {
  ThreadTeam team;
  Grid grid{.count = {80, 4, 200}, .low = {}, .spacing = {1.25 * mm, 1.25 * mm, 1.25 * mm}};
  Wall plate{"plate", {0, 0, 100 * mm}, {100 * mm, 0, 100 * mm}, {{30 * mm, 70 * mm}}};
  Domain domain{{.low = {},
                 .high = {100 * mm, 5 * mm, 250 * mm},
                 .faces = {FaceKind::wall, FaceKind::wall, FaceKind::symmetry, FaceKind::symmetry, FaceKind::wall,
                           FaceKind::open}},
                {plate}};
  std::vector<Vector3> position, velocity;
  std::vector<double> smoothing_length;
  coupling::Deposition deposition{grid, domain};
  Solids solids{grid};
  double solid_volume = 0.6 * spacing * spacing * spacing;

  explicit Hopper(int threads) : team(threads) {
    for (int k = 0; k < 50; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 60; ++i) {
          const Vector3 x{(i + 0.5) * spacing, (j + 0.5) * spacing, 100 * mm + (k + 0.5) * spacing};
          const bool falls = x.x > 30 * mm && x.x < 70 * mm && x.z < 140 * mm;
          position.push_back(x);
          velocity.push_back({0, 0, falls ? -0.3 * (140 * mm - x.z) / (40 * mm) : 0});
          smoothing_length.push_back(spacing);
        }
  }
  void deposit() {
    deposition.find_weights(team, position, smoothing_length);
    deposition.deposit(team, solid_volume, velocity, solids.fraction, solids.flux);
  }
};

void step(benchmark::State& state) {
  Hopper hopper(static_cast<int>(state.range(0)));
  hopper.deposit();
  Parameters p;
  p.boundaries.kind = {FlowBoundary::no_slip,   FlowBoundary::no_slip, FlowBoundary::free_slip,
                       FlowBoundary::free_slip, FlowBoundary::no_slip, FlowBoundary::open};
  p.tolerance = 1e-5;
  AirFlow flow(hopper.grid, p, {hopper.plate});
  AirState air(hopper.grid);
  FaceField impulse = hopper.grid.face_field();
  flow.begin(hopper.team, hopper.solids, air);
  for (int n = 0; n < 20; ++n) flow.advance(hopper.team, 100e-6, hopper.solids, air, impulse);
  double iterations = 0;
  for (auto _ : state) {
    flow.advance(hopper.team, 100e-6, hopper.solids, air, impulse);
    iterations += flow.iterations();
  }
  state.counters["iterations"] = iterations / static_cast<double>(state.iterations());
}

void deposit(benchmark::State& state) {
  Hopper hopper(static_cast<int>(state.range(0)));
  for (auto _ : state) hopper.deposit();
}

BENCHMARK(step)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(deposit)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace talus::air

BENCHMARK_MAIN();
