// SPDX-License-Identifier: Apache-2.0
/// How fast the direct sum over pairs is on one thread, beside the machine's arithmetic peak measured in the same run.
/// Every figure is the best of many repetitions: on a shared machine the rest is other people's work.
///
/// Counters: pairs/s (directed: N (N - 1) an evaluation, packing and gathering included); Gflop/s, a fused
/// multiplication and addition counted as two; of_peak, those over the peak; slots, the share of the multiplication
/// slots that are in use (a multiplication fills one as a fused operation does; additions have slots of their own).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "base/random.hpp"
#include "models/cloud/pair_sum.hpp"
#include "numerics/cell_grid.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace talus::cloud {
namespace {

using hydrodynamics::Mobility;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr int chains = 12, rounds = 20000;

#if defined(__x86_64__)
#define TALUS_PEAK(name, instructions, Register, set1, fused)                                    \
  __attribute__((target(instructions))) void name() {                                            \
    Register chain[chains];                                                                      \
    const Register factor = set1(0.999f), term = set1(0.001f);                                   \
    _Pragma("GCC unroll 16") for (int c = 0; c < chains; ++c) chain[c] = term;                   \
    for (int k = 0; k < rounds; ++k) _Pragma("GCC unroll 16") for (int c = 0; c < chains; ++c) { \
        chain[c] = fused(chain[c], factor, term);                                                \
        asm volatile("" : "+v"(chain[c]));                                                       \
      }                                                                                          \
  }
TALUS_PEAK(fused_512_double, "avx512f", __m512d, _mm512_set1_pd, _mm512_fmadd_pd)
TALUS_PEAK(fused_512_single, "avx512f", __m512, _mm512_set1_ps, _mm512_fmadd_ps)
TALUS_PEAK(fused_256_double, "avx2,fma", __m256d, _mm256_set1_pd, _mm256_fmadd_pd)
TALUS_PEAK(fused_256_single, "avx2,fma", __m256, _mm256_set1_ps, _mm256_fmadd_ps)
#undef TALUS_PEAK
#endif

/// Fused operations a second, counted in numbers (not registers), in independent chains.
double peak(InstructionSet set, Precision precision) {
  const bool single = precision == Precision::single_precision;
#if defined(__x86_64__)
  void (*const run)() = set == InstructionSet::avx512 ? (single ? fused_512_single : fused_512_double)
                                                      : (single ? fused_256_single : fused_256_double);
  const double begin = now();
  run();
  const int lanes = (set == InstructionSet::avx512 ? 8 : 4) * (single ? 2 : 1);
  return double(chains) * rounds * lanes / (now() - begin);
#else
  return 0 * double(single) * double(set == InstructionSet::portable);
#endif
}

/// Operations for one pair (both directions), after those that a row or column pays once: fused, multiplications
/// (the estimate of the reciprocal square root uses a multiplication's slot), additions.
struct Operations {
  int fused, products, sums;
};
Operations operations(Mobility mobility, int d, Precision precision) {
  Operations n{0, 0, d};                                                         // separation
  n.fused += d - 1, n.products += 1;                                             // its square
  n.products += 3, n.fused += precision == Precision::double_precision ? 4 : 2;  // reciprocal square root
  n.products += 3;                                                               // its powers
  if (mobility == Mobility::zuk_2014)
    n.fused += 2, n.products += 2, n.sums += 2;  // size, reach and coefficients for both directions
  else
    n.fused += 2 * 2;
  n.fused += 2 * (d - 1), n.products += 2 * 2;  // force along the separation
  n.fused += 2 * 2 * d;                         // velocities
  return n;
}

/// Spheres at half the densest packing's fraction, sorted in space.
struct Setup {
  std::vector<Vector3> position, force, velocity;
  std::vector<double> radius;
  std::vector<std::uint32_t> order;

  Setup(std::size_t count, Motion motion) : velocity(count) {
    Random random(1);
    const double n = static_cast<double>(count), a = 5e-3;
    const double edge = motion == Motion::xyz ? a * std::cbrt(8 * n) : a * std::sqrt(6.3 * n);
    for (std::size_t i = 0; i < count; ++i) {
      position.push_back(
          {random.uniform(0, edge), random.uniform(0, edge), motion == Motion::xyz ? random.uniform(0, edge) : 0.0});
      force.push_back({random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4)});
      radius.push_back(a * random.uniform(0.95, 1.05));
    }
    order = spatial_order(position, 4 * a);
  }
};

void pair_sum(benchmark::State& state, Mobility mobility, Motion motion, Precision precision, InstructionSet set) {
  if (!is_available(set)) {
    state.SkipWithError("not on this processor");
    return;
  }
  const auto count = static_cast<std::size_t>(state.range(0));
  Setup setup(count, motion);
  ThreadTeam team;
  PairSum sum({mobility, motion, precision, set, 1.82e-5}, setup.radius, setup.order);
  double least = 1e9, most = 0;
  for (auto _ : state) {
    most = std::max(most, peak(set, precision));
    const double begin = now();
    sum.velocities(team, setup.position, setup.force, setup.velocity);
    const double time = now() - begin;
    state.SetIterationTime(time);
    least = std::min(least, time);
  }
  const Operations n = operations(mobility, motion == Motion::xyz ? 3 : 2, precision);
  const double pairs = static_cast<double>(count) * static_cast<double>(count - 1) / least;
  const double flops = pairs / 2 * (2 * n.fused + n.products + n.sums);
  state.counters["pairs/s"] = pairs;
  state.counters["Gflop/s"] = flops * 1e-9;
  state.counters["peak_Gflop/s"] = 2e-9 * most;
  state.counters["of_peak"] = flops / (2 * most);
  state.counters["slots"] = pairs / 2 * (n.fused + n.products) / most;
}

const int registered = [] {
  for (const auto set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::portable})
    for (const auto mobility : {Mobility::rotne_prager_1969, Mobility::zuk_2014})
      for (const auto motion : {Motion::xy, Motion::xyz})
        for (const auto precision : {Precision::double_precision, Precision::single_precision}) {
          const std::string name = std::string(choice_name(set)) + "/" + std::string(choice_name(mobility)) + "/" +
                                   std::string(choice_name(motion)) + "/" + std::string(choice_name(precision));
          auto* entry = benchmark::RegisterBenchmark(name.c_str(), pair_sum, mobility, motion, precision, set);
          entry->Arg(2000)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(0.3);
          if (motion == Motion::xyz) entry->Arg(10000);
        }
  return 0;
}();

}  // namespace
}  // namespace talus::cloud

BENCHMARK_MAIN();
