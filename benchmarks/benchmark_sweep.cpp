// SPDX-License-Identifier: Apache-2.0
/// What a step of the continuum costs, and its parts: the sums over pairs with the packing of records, a rebuild of the
/// neighbour lists, the law applied to all particles, whole steps. The bed of the paper's hopper (60 x 3 x 50 particles
/// between mirrors, some 39 neighbours each), and beds of 100,000 and 10^6 particles; arguments: particles along x, y,
/// z, and threads.
#include <benchmark/benchmark.h>

#include "base/random.hpp"
#include "models/continuum/model.hpp"
#include "models/continuum/population.hpp"
#include "models/continuum/setup/initial.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {
namespace {

/// With a speed of sound of 100 m/s.
Setup setup_of(const Parameters& p) {
  Setup setup(p);
  setup.sound_speed = 100;
  return setup;
}

/// The bed at rest on an open slit, its particles a little out of place.
struct Bed {
  Parameters parameters;
  State state;
  Material material;
  ThreadTeam team;
  Domain domain;
  PairSums pairs;
  Rates rates;
  std::vector<double> h;

  static Parameters hopper(const benchmark::State& run) {
    constexpr double spacing = 0.1 / 60;
    Parameters p;
    p.box.width = static_cast<double>(run.range(0)) * spacing;
    p.box.depth = static_cast<double>(run.range(1)) * spacing;
    p.box.height = static_cast<double>(run.range(2) + 100) * spacing;
    p.plate.height = 60 * spacing;
    p.plate.slit_left = 0.3 * p.box.width;
    p.plate.slit_right = 0.7 * p.box.width;
    p.gate.opens = GateOpens::from_the_start;
    p.bed.spacing = spacing;
    p.bed.height = static_cast<double>(run.range(2)) * spacing;
    // As cases/yuu2011-hopper-vacuum.toml.
    granular::CriticalState::Parameters law;
    law.static_friction = 0.48;
    law.dynamic_friction = 0.72;
    law.inertial_number = 0.27;
    law.critical_packing = 0.555;
    law.packing_slope = 0.09;
    law.random_loose_packing = 0.52;
    law.dilatancy = 8;
    law.dilatant_friction = 0.5;
    law.ageing_strength = 0.097;
    p.law = law;
    p.collisions.form = granular::Collisions::none;
    p.sph.viscosity_alpha = 0.01;
    p.integration.method = Method::leapfrog;
    p.integration.courant = 1.2;
    return p;
  }

  explicit Bed(const benchmark::State& run)
      : parameters(hopper(run)),
        state(initial_state(Setup(parameters))),
        material(parameters),
        team(static_cast<int>(run.range(3))),
        domain(Boundary(parameters).domain()),
        pairs(setup_of(parameters), domain) {
    Random random(1);
    const auto shift = [&] { return 0.1 * parameters.bed.spacing * random.uniform(-1, 1); };
    for (Vector3& x : state.position) x += Vector3{shift(), shift(), shift()};
    for (Vector3& u : state.velocity)
      u = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
    for (double& density : state.density) density *= random.uniform(0.999, 1.001);
    for (auto& stress : state.material.stress)
      for (double& component : stress) component = random.uniform(0, 1000);
    Share all(one_process());
    sort_for_locality(state, all, sph::support * parameters.bed.spacing);
    for (const double density : state.density) h.push_back(pairs.smoothing_length(density));
    pairs.find_neighbours(team, state.position, h);
    evaluate(PairTerms::all);
  }
  void evaluate(PairTerms terms) {
    pairs(team, {state.position, state.velocity, state.density, h, state.material}, terms, rates);
  }
};

/// Neighbours of all particles, images among them.
std::size_t pairs_of(const Bed& bed) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < bed.h.size(); ++i) pairs += bed.pairs.neighbourhood().of(i).size();
  return pairs;
}

void sweep(benchmark::State& run, PairTerms terms) {
  Bed bed(run);
  for (auto _ : run) bed.evaluate(terms);
  run.SetItemsProcessed(static_cast<std::int64_t>(pairs_of(bed)) * run.iterations());
}
void sweep_gradients(benchmark::State& run) {
  sweep(run, PairTerms::gradients);
}
void sweep_forces(benchmark::State& run) {
  sweep(run, PairTerms::forces);
}
void sweep_all(benchmark::State& run) {
  sweep(run, PairTerms::all);
}

void neighbours(benchmark::State& run) {
  Bed bed(run);
  for (auto _ : run) bed.pairs.find_neighbours(bed.team, bed.state.position, bed.h);
  run.SetItemsProcessed(static_cast<std::int64_t>(bed.h.size()) * run.iterations());
}

void law(benchmark::State& run) {
  Bed bed(run);
  for (auto _ : run)
    bed.material.update(bed.team, bed.state.material, bed.rates.velocity_gradient, {}, bed.state.density, 1e-6,
                        bed.state.material, true);
  run.SetItemsProcessed(static_cast<std::int64_t>(bed.h.size()) * run.iterations());
}

void step(benchmark::State& run, const Parameters& p) {
  ThreadTeam team(static_cast<int>(run.range(3)));
  Continuum model(p);
  model.begin(team);
  for (int n = 0; n < 100; ++n) model.advance(team);
  for (auto _ : run) model.advance(team);
  run.SetItemsProcessed(static_cast<std::int64_t>(model.state().position.size()) * run.iterations());
}
void step_leapfrog(benchmark::State& run) {
  step(run, Bed::hopper(run));
}
/// As cases/yuu2011-hopper-vacuum-fast.toml.
void step_leapfrog_single(benchmark::State& run) {
  Parameters p = Bed::hopper(run);
  p.integration.courant = 1.5;
  p.integration.skin = 0.6;
  p.integration.skin_at_rest = 0.02;
  p.integration.pair_precision = PairPrecision::in_single;
  step(run, p);
}
void step_runge_kutta(benchmark::State& run) {
  Parameters p = Bed::hopper(run);
  p.integration.method = Method::runge_kutta;
  p.integration.courant = 0.3;
  step(run, p);
}

void sizes(benchmark::internal::Benchmark* stage) {
  stage->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMicrosecond);
  for (const int threads : {1, 2}) stage->Args({60, 3, 50, threads});
  for (const int threads : {1, 2}) stage->Args({100, 20, 50, threads});
  for (const int threads : {1, 2}) stage->Args({200, 20, 250, threads});
}
BENCHMARK(sweep_gradients)->Apply(sizes);
BENCHMARK(sweep_forces)->Apply(sizes);
BENCHMARK(sweep_all)->Apply(sizes);
BENCHMARK(neighbours)->Apply(sizes);
BENCHMARK(law)->Apply(sizes);
BENCHMARK(step_leapfrog)->Apply(sizes);
BENCHMARK(step_leapfrog_single)->Apply(sizes);
BENCHMARK(step_runge_kutta)->Apply(sizes);

}  // namespace
}  // namespace talus::continuum

BENCHMARK_MAIN();
