// SPDX-License-Identifier: Apache-2.0
/// The air's pressure equation on the grid of Yuu & Umekage 2011, 80 x 4 x 200 cells with a plate and its slit, on one
/// thread and more: cold to 1e-6, warm as between the time steps of the air, and what new coefficients cost.
///
/// The coefficient is 1 in free air and `contrast` times smaller in a bed above the plate. Warm: the source turns by a
/// given share (the change of the divergence between two steps) and the last solution is the guess.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/random.hpp"
#include "numerics/grid/poisson.hpp"

namespace talus {
namespace {

struct Hopper {
  Grid grid{.count = {80, 4, 200}, .low = {}, .spacing = {1.25e-3, 1.25e-3, 1.25e-3}};
  FaceField conductance = grid.face_field();
  CellField source = grid.cell_field(), change = grid.cell_field();

  explicit Hopper(double contrast) {
    Random random(3);
    const auto [nx, ny, nz] = grid.count;
    const auto coefficient = [&](int i, int j, int k) {
      const double bed = k >= 80 && k < 147 ? 1 / contrast : 1;
      return bed * (1 + 0.1 * std::sin(0.7 * i + 1.3 * j + 0.9 * k));
    };
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          const std::size_t c = grid.index(i, j, k);
          const double here = coefficient(i, j, k);
          if (i > 0) conductance[0][c] = 0.5 * (here + coefficient(i - 1, j, k));
          if (j > 0) conductance[1][c] = 0.5 * (here + coefficient(i, j - 1, k));
          const bool slit = i >= 24 && i < 56;
          if (k > 0 && (k != 80 || slit)) conductance[2][c] = 0.5 * (here + coefficient(i, j, k - 1));
          source[c] = std::sin(0.05 * i) * std::cos(0.03 * k) + 0.2 * (random.uniform() - 0.5);
          change[c] = std::cos(0.04 * i + 0.02 * k) + 0.2 * (random.uniform() - 0.5);
        }
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) conductance[2][grid.index(i, j, nz)] = 2;
  }
};

void cold(benchmark::State& state) {
  const Hopper hopper(static_cast<double>(state.range(0)));
  ThreadTeam team(static_cast<int>(state.range(1)));
  PoissonSolver solver(hopper.grid, {false, false, false});
  solver.set_conductance(team, hopper.conductance);
  PoissonSolver::Outcome outcome;
  for (auto _ : state) {
    CellField value = hopper.grid.cell_field();
    outcome = solver.solve(team, hopper.source, value, {.tolerance = 1e-6});
  }
  state.counters["iterations"] = outcome.iterations;
}

void warm(benchmark::State& state) {
  const Hopper hopper(30);
  ThreadTeam team(static_cast<int>(state.range(1)));
  PoissonSolver solver(hopper.grid, {false, false, false});
  solver.set_conductance(team, hopper.conductance);
  CellField value = hopper.grid.cell_field();
  solver.solve(team, hopper.source, value, {.tolerance = 1e-8});
  CellField source = hopper.source;
  for (std::size_t c = 0; c < source.size(); ++c) source[c] += hopper.change[c] / static_cast<double>(state.range(0));
  PoissonSolver::Outcome outcome;
  for (auto _ : state) {
    CellField guess = value;
    outcome = solver.solve(team, source, guess, {.tolerance = 1e-5});
  }
  state.counters["iterations"] = outcome.iterations;
}

void new_coefficients(benchmark::State& state) {
  const Hopper hopper(30);
  ThreadTeam team(static_cast<int>(state.range(0)));
  PoissonSolver solver(hopper.grid, {false, false, false});
  for (auto _ : state) solver.set_conductance(team, hopper.conductance);
}

void cone(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Grid grid{.count = {n, n, n}, .low = {}, .spacing = {1.0 / n, 1.0 / n, 1.0 / n}};
  FaceField conductance = grid.face_field();
  CellField source = grid.cell_field();
  Random random(3);
  const auto inside = [&](int i, int j, int k) {
    const Vector3 x = grid.centre(i, j, k);
    return x.z > 0.3 && x.z < 0.8 && std::hypot(x.x - 0.5, x.y - 0.5) < 0.1 + 0.6 * (x.z - 0.3);
  };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::size_t c = grid.index(i, j, k);
        const bool own = inside(i, j, k);
        const bool beyond_an_end = grid.centre(i, j, k - 1).z < 0.3 || grid.centre(i, j, k).z > 0.8;
        conductance[0][c] = i > 0 && inside(i - 1, j, k) == own;
        conductance[1][c] = j > 0 && inside(i, j - 1, k) == own;
        conductance[2][c] = k > 0 && (beyond_an_end || inside(i, j, k - 1) == own);
        if (k + 1 == n) conductance[2][grid.index(i, j, n)] = 2;
        source[c] = random.uniform() - 0.4;
      }
  ThreadTeam team;
  PoissonSolver solver(grid, {false, false, false});
  solver.set_conductance(team, conductance);
  PoissonSolver::Outcome outcome;
  for (auto _ : state) {
    CellField value = grid.cell_field();
    outcome = solver.solve(team, source, value, {.tolerance = 1e-6});
  }
  state.counters["iterations"] = outcome.iterations;
}

BENCHMARK(cone)->ArgName("cells")->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(cold)
    ->ArgNames({"contrast", "threads"})
    ->ArgsProduct({{1, 30, 100, 5000}, {1}})
    ->Args({30, 2})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK(warm)
    ->ArgNames({"change", "threads"})
    ->ArgsProduct({{10, 100, 1000}, {1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK(new_coefficients)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace talus

BENCHMARK_MAIN();
