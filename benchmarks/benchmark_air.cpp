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
    deposition.deposit(team, solid_volume, {}, velocity, solids.fraction, solids.flux);
  }
};

/// The grains of the hopper at the starts of the next steps of the air, falling; read forwards and backwards in turn,
/// so that the pressure has as much to do as in a run.
struct Falling {
  static constexpr int count = 12;
  std::vector<Solids> solids;

  Falling(Hopper& hopper, double dt) {
    for (int n = 0; n < count; ++n) {
      hopper.deposit();
      solids.push_back(hopper.solids);
      for (std::size_t i = 0; i < hopper.position.size(); ++i) hopper.position[i] += dt * hopper.velocity[i];
    }
  }
  const Solids& at(int step) const {
    const int n = step % (2 * count - 2);
    return solids[static_cast<std::size_t>(n < count ? n : 2 * count - 2 - n)];
  }
};

/// As the paper's cases have it (docs/design/coupling.md).
Parameters paper() {
  Parameters p;
  p.continuity = Continuity::air_alone;
  p.formulation = Formulation::model_b;
  return p;
}

void step(benchmark::State& state) {
  Hopper hopper(static_cast<int>(state.range(0)));
  constexpr double dt = 100e-6;
  const Falling falling(hopper, dt);
  AirFlow flow(hopper.grid, paper(), {hopper.plate});
  AirState air(hopper.grid);
  FaceField impulse = hopper.grid.face_field();
  flow.begin(hopper.team, falling.at(0), air);
  int n = 0;
  for (; n < 22; ++n) flow.advance(hopper.team, dt, falling.at(n), air, impulse);
  double iterations = 0;
  for (auto _ : state) {
    flow.advance(hopper.team, dt, falling.at(n++), air, impulse);
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
