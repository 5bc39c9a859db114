// SPDX-License-Identifier: Apache-2.0
/// The sums over pairs in single precision beside those in double, and what a run keeps of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/instruction_set.hpp"
#include "models/continuum/evaluation.hpp"

namespace talus::continuum {
namespace {

/// A bed on a plate with a slit, disturbed, with velocities and stresses of any size and sign.
struct DisturbedBed : Evaluation {
  DisturbedBed(PairPrecision precision, InstructionSet set)
      : Evaluation([&] {
          Parameters p = small_hopper();
          p.sph.viscosity_alpha = 0.1;
          p.integration.pair_precision = precision;
          p.integration.instruction_set = set;
          return p;
        }()) {
    disturb(0.3);
    randomise(0.9);
  }
};

/// Collects the differences of two columns over the size of the first.
struct Difference {
  double square = 0, size = 0;
  void add(double a, double b) { square += (a - b) * (a - b), size += a * a; }
  double relative() const { return std::sqrt(square / size); }
};

TEST(PairPrecision, SingleSumsAreThoseInDoubleToTheRoundOffOfFloats) {
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!is_available(set)) continue;
    DisturbedBed exact(PairPrecision::in_double, set);
    DisturbedBed single(PairPrecision::in_single, set);
    exact.evaluate();
    for (const PairTerms terms : {PairTerms::all, PairTerms::gradients, PairTerms::forces}) {
      single.evaluate(terms);
      Difference gradient, density, force, wall, packing;
      for (std::size_t i = 0; i < exact.state.position.size(); ++i) {
        for (std::size_t c = 0; c < 9; ++c)
          gradient.add(exact.rates.velocity_gradient.component[c][i], single.rates.velocity_gradient.component[c][i]);
        density.add(exact.rates.density_rate[i], single.rates.density_rate[i]);
        for (int axis = 0; axis < 3; ++axis)
          force.add(exact.rates.acceleration[i][axis], single.rates.acceleration[i][axis]);
        packing.add(exact.rates.kernel_density[i], single.rates.kernel_density[i]);
      }
      ASSERT_EQ(exact.rates.by_walls.walls, single.rates.by_walls.walls);
      for (std::size_t n = 0; n < exact.rates.by_walls.value.size(); ++n)
        wall.add(exact.rates.by_walls.value[n], single.rates.by_walls.value[n]);
      for (const Difference& d : {gradient, density, force, wall, packing}) EXPECT_LT(d.relative(), 2e-6);
      EXPECT_GT(force.relative(), 1e-9) << "not in single precision";
    }
  }
}

TEST(PairPrecision, PlacesAreAsGoodFarFromTheOrigin) {
  // Five metres from the origin a float holds places to 2.4e-7 m, 2.4e-5 of the spacing: ten times the tolerance.
  Parameters p = free_block(6, 5, 7);
  p.integration.pair_precision = PairPrecision::in_single;
  Evaluation e(p);
  e.disturb(0.1);
  const Tensor3<> exact{1, -2, 0.5, 3, -1, 0.25, 0.75, 2, -0.5};
  const Vector3 middle{0.5, 0, 5};
  e.velocity([&](const Vector3& x) { return linear(exact)(x - middle); });
  e.evaluate();
  for (std::size_t i = 0; i < e.rates.velocity_gradient.size(); ++i) {
    const Tensor3<> d = e.rates.velocity_gradient[i] - exact;
    for (const double c : {d.xx, d.xy, d.xz, d.yx, d.yy, d.yz, d.zx, d.zy, d.zz}) EXPECT_NEAR(c, 0, 5e-6);
  }
}

TEST(PairPrecision, InSinglePrecisionForcesCancelToTheRoundOffOfFloats) {
  DisturbedBed e(PairPrecision::in_single, InstructionSet::automatic);
  e.evaluate();
  const Evaluation::Accelerations sums = e.accelerations();
  EXPECT_LT(norm(sums.total - sums.by_walls), 1e-7 * sums.size);
}

/// Period of a small standing pressure wave in a closed column, over its length and the speed of the continuum's.
double wave_period(int particles, PairPrecision precision) {
  Parameters p = column(2, 1, particles);
  p.box.top = FaceKind::wall;
  p.gravity.acceleration = 0;
  p.integration.method = Method::leapfrog;
  p.integration.pair_precision = precision;
  ThreadTeam team(1);
  const double length = particles * spacing, c = std::sqrt(2e6 / 1500 * lattice_moment());
  const auto mode = [&](const Vector3& x) { return std::sin(std::numbers::pi * x.z / length); };
  Continuum model(p);
  State& s = model.mutable_state();
  for (std::size_t i = 0; i < s.position.size(); ++i) s.velocity[i] = {0, 0, 1e-3 * mode(s.position[i])};
  model.begin(team);
  std::vector<double> zeros;
  double before = 1;
  while (zeros.size() < 3) {
    model.advance(team);
    double amplitude = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i) amplitude += s.velocity[i].z * mode(s.position[i]);
    if ((amplitude > 0) != (before > 0)) zeros.push_back(s.time - s.last_step * amplitude / (amplitude - before));
    before = amplitude;
  }
  return (zeros.back() - zeros.front()) * c / (2 * length);
}

TEST(PairPrecision, AWaveConvergesInSinglePrecisionAsInDouble) {
  // Strains of 3e-5. What the lattice's dispersion and the step leave falls with the square of the spacing.
  double coarser = 0;
  for (const int particles : {10, 20, 40}) {
    const double error = wave_period(particles, PairPrecision::in_single) - 1;
    EXPECT_NEAR(error, wave_period(particles, PairPrecision::in_double) - 1, 1e-5);
    if (coarser != 0) {
      EXPECT_NEAR(coarser / error, 4, 0.4);
    }
    coarser = error;
  }
}

TEST(PairPrecision, InSinglePrecisionARunIsTheSameForAnyThreadsAndResumed) {
  Parameters p = small_hopper();
  p.integration.method = Method::leapfrog;
  p.integration.pair_precision = PairPrecision::in_single;
  expect_same_for_any_threads_and_resumed(p, 300);
}

}  // namespace
}  // namespace talus::continuum
