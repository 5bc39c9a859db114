// SPDX-License-Identifier: Apache-2.0
/// A constitutive law applied to all particles of the hopper's bed: what one evaluation of the stress costs.
#include <benchmark/benchmark.h>

#include <vector>

#include "base/random.hpp"
#include "physics/granular/law.hpp"

namespace talus::granular {
namespace {

/// \tparam Number double, or lanes
template <class Number>
void update_bed(benchmark::State& state, const LawParameters& parameters) {
  constexpr std::size_t particles = 9000, each = sizeof(Number) / sizeof(double);
  const AnyLaw any = make_law(parameters, 2500);
  std::visit(
      [&]<class Law>(const Law& law) {
        Random random(1);
        const std::size_t count = particles / each;
        std::vector<MaterialPoint<Law, Number>> old(count), next(count);
        std::vector<Tensor3<Number>> gradient(count);
        std::vector<Number> density(count);
        for (std::size_t i = 0; i < count; ++i) {
          gradient[i].xz = Number(random.uniform(-20, 20));
          gradient[i].zz = Number(random.uniform(-10, 9));
          density[i] = Number(random.uniform(1499, 1503));
        }
        for (int step = 0; step < 100; ++step)  // all over the loading curve and off it
          for (std::size_t i = 0; i < count; ++i) old[i] = law.update(old[i], gradient[i], density[i], 4e-6);
        for (auto _ : state) {
          for (std::size_t i = 0; i < count; ++i) next[i] = law.update(old[i], gradient[i], density[i], 4e-6);
          benchmark::DoNotOptimize(next.data());
          benchmark::ClobberMemory();
        }
      },
      any);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * particles));
}

void isotropic(benchmark::State& state) {
  update_bed<double>(state, {});
}
void isotropic_in_lanes(benchmark::State& state) {
  update_bed<SimdVector<double>>(state, {});
}
void printed(benchmark::State& state) {
  update_bed<double>(state, YuuUmekagePrinted::Parameters{});
}
void drucker_prager(benchmark::State& state) {
  update_bed<double>(state, DruckerPrager::Parameters{});
}
void linear_elastic(benchmark::State& state) {
  update_bed<double>(state, LinearElastic::Parameters{});
}
BENCHMARK(isotropic);
BENCHMARK(isotropic_in_lanes);
BENCHMARK(printed);
BENCHMARK(drucker_prager);
BENCHMARK(linear_elastic);

}  // namespace
}  // namespace talus::granular

BENCHMARK_MAIN();
