// SPDX-License-Identifier: Apache-2.0
/// The regularisation of the stress: a uniform ratio of deviator and pressure stays, what alternates decays by what the
/// strain makes, and where nothing moves or nothing is borne nothing changes.
#include "models/continuum/pairs/stress_regularisation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/evaluation.hpp"

namespace talus::continuum {
namespace {

constexpr double shear_modulus = 1e6;  // Pa

Parameters regularised(Parameters p, double share = 1) {
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 2e6;
  law.shear_modulus = shear_modulus;
  p.law = law;
  p.sph.stress_regularisation = share;
  return p;
}

/// A lattice without ends.
Parameters endless() {
  Parameters p = regularised(column(6, 6, 6));
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::periodic;
  return p;
}

void set_shear(Rates& rates, double rate) {
  for (std::size_t c = 0; c < 9; ++c)
    for (double& component : rates.velocity_gradient.component[c]) component = c == 1 ? rate : 0;
}

TEST(StressRegularisation, AUniformRatioStaysUnderAnyPressures) {
  for (const PairPrecision precision : {PairPrecision::in_double, PairPrecision::in_single}) {
    Parameters p = regularised(free_block(6, 5, 7));
    p.integration.pair_precision = precision;
    Evaluation e(p);
    e.disturb(0.2);
    Random random(7);
    const double ratio[6] = {1.3, 0.9, 0.8, 0.2, -0.1, 0.3};
    for (std::size_t i = 0; i < e.state.position.size(); ++i) {
      const double pressure = random.uniform(10, 1000);
      for (std::size_t c = 0; c < 6; ++c) e.state.material.stress[c][i] = pressure * ratio[c];
    }
    const auto before = e.state.material.stress;
    e.evaluate();
    set_shear(e.rates, 10);
    regularise_stress(e.team, p, 1e-3, e.rates, e.state);
    const double rounding = precision == PairPrecision::in_double ? 1e-12 : 1e-5;
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t i = 0; i < before[c].size(); ++i)
        EXPECT_NEAR(e.state.material.stress[c][i], before[c][i], rounding * 1000);
  }
}

/// The mean around a particle has a share f of what alternates, that of the kernel's signed sum: a step leaves
/// 1 - w (1 - f).
TEST(StressRegularisation, DeviatorsThatAlternateDecayByTheStrain) {
  const Parameters p = endless();
  Evaluation e(p);
  const double pressure = 1000, rate = 5, dt = 1e-4, q = shear_modulus * rate * dt / pressure, w = q / (1 + q);
  e.pressure(pressure);
  for (std::size_t i = 0; i < e.state.position.size(); ++i)
    e.state.material.stress[3][i] = 100 * alternating(e.state.position[i]);
  const double all = lattice_density(1), signed_sum = lattice_sum([](int, double r) {
                                           return (std::lround(r * r) % 2 == 0 ? 1 : -1) * sph::cubic_spline(r, 1.0);
                                         });
  double left = 100;
  for (int k = 0; k < 3; ++k) {
    e.evaluate();
    set_shear(e.rates, rate);
    regularise_stress(e.team, p, dt, e.rates, e.state);
    left *= 1 - w * (1 - signed_sum / all);
    for (std::size_t i = 0; i < e.state.position.size(); ++i) {
      EXPECT_NEAR(e.state.material.stress[3][i], left * alternating(e.state.position[i]), 1e-9 * 100);
      EXPECT_NEAR(e.state.material.stress[0][i], pressure, 1e-9 * pressure);
    }
  }
  EXPECT_LT(left, 50);
}

TEST(StressRegularisation, NothingChangesAtRestOrApart) {
  const Parameters p = endless();
  Evaluation e(p);
  e.randomise(0.9);
  for (auto& component : e.state.material.stress) component[7] = 0;
  const auto before = e.state.material.stress;
  e.evaluate();
  set_shear(e.rates, 0);
  regularise_stress(e.team, p, 1e-3, e.rates, e.state);
  EXPECT_EQ(e.state.material.stress, before);
  set_shear(e.rates, 10);
  regularise_stress(e.team, p, 1e-3, e.rates, e.state);
  EXPECT_NE(e.state.material.stress, before);
  for (const auto& component : e.state.material.stress) EXPECT_EQ(component[7], 0);
}

TEST(StressRegularisation, OtherSumsKeepTheirBits) {
  Parameters p = regularised(free_block(6, 5, 7), 0);
  Evaluation without(p);
  p.sph.stress_regularisation = 1;
  Evaluation with(p);
  for (Evaluation* e : {&without, &with}) e->disturb(0.2), e->randomise(0.9), e->evaluate();
  EXPECT_TRUE(without.rates.stress_around[0].empty());
  EXPECT_EQ(with.rates.acceleration, without.rates.acceleration);
  EXPECT_EQ(with.rates.kernel_density, without.rates.kernel_density);
  EXPECT_EQ(with.rates.velocity_gradient.component, without.rates.velocity_gradient.component);
}

TEST(StressRegularisation, HasTheSameBitsForAnyNumberOfThreadsAndResumed) {
  for (const Method method : {Method::runge_kutta, Method::leapfrog}) {
    Parameters p = regularised(small_hopper());
    p.integration.method = method;
    expect_same_for_any_threads_and_resumed(p, 200);
  }
}

}  // namespace
}  // namespace talus::continuum
