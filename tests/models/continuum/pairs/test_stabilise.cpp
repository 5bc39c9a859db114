// SPDX-License-Identifier: Apache-2.0
/// The stabilisers of the sums: linear fields stay, what alternates decays, momentum is kept, and without them nothing
/// changes.
#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/evaluation.hpp"

namespace talus::continuum {
namespace {

/// Under pressure from the start: hourglasses are damped only where grains bear one.
struct Stabilised : Evaluation {
  explicit Stabilised(const Parameters& p) : Evaluation(p) { pressure(1000); }
};

/// Lattice without ends.
Parameters endless() {
  Parameters p = column(6, 6, 6);
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::periodic;
  return p;
}

TEST(Stabilise, DensitiesThatAreLinearStay) {
  Parameters p = free_block(6, 5, 7);
  p.sph.density_diffusion = 0.1;
  Stabilised e(p);
  e.disturb(0.2);
  e.density([](const Vector3& x) { return 1500 + 2000 * (x.x - 0.5) - 1500 * x.y + 900 * (x.z - 5); });
  double variation = 0;
  for (const double density : e.state.density) variation = std::max(variation, std::abs(density - 1500));
  e.evaluate();
  // A jump of that size would fade at the rate 2 delta c/spacing.
  const double scale = variation * 2 * 0.1 * 50 / spacing;
  for (const double rate : e.rates.density_rate) EXPECT_LT(std::abs(rate), 1e-11 * scale);
}

TEST(Stabilise, DensitiesThatAlternateDecayAndTheirMeanStays) {
  Parameters p = endless();
  p.sph.density_diffusion = 0.1;
  Stabilised e(p);
  e.density([](const Vector3& x) { return 1500 + alternating(x); });
  const double step = 2e-4;
  double last = 1;
  for (int k = 0; k < 10; ++k) {
    e.evaluate();
    double mean = 0, most = 0;
    for (std::size_t i = 0; i < e.state.density.size(); ++i) e.state.density[i] += step * e.rates.density_rate[i];
    for (const double density : e.state.density) mean += (density - 1500) / static_cast<double>(e.state.density.size());
    for (const double density : e.state.density) most = std::max(most, std::abs(density - 1500));
    EXPECT_LT(most, 0.95 * last) << k;
    EXPECT_GT(most, 0.1 * last) << k;
    EXPECT_NEAR(mean, 0, 2e-3);  // of the volumes, which differ by a thousandth, not of the densities
    last = most;
  }
}

TEST(Stabilise, GrainsThatAreLooseDoNotDiffuse) {
  Parameters p = endless();
  p.sph.density_diffusion = 0.1;
  Stabilised e(p);
  e.density([](const Vector3& x) { return alternating(x) > 0 ? 1500 : 1200; });
  e.evaluate();
  for (const double rate : e.rates.density_rate) EXPECT_NEAR(rate, 0, 1e-8);  // a jump of 300 would fade at 3e5
}

/// Particles off the lattice that move with a linear velocity are accelerated as without the damping of hourglasses.
void expect_no_damping(Parameters p, const Tensor3<>& gradient) {
  Stabilised without(p);
  p.sph.hourglass_damping = 0.3;
  Stabilised with(p);
  for (Stabilised* e : {&without, &with}) {
    e->disturb(0.2);
    e->velocity(linear(gradient));
    e->evaluate();
  }
  for (std::size_t i = 0; i < with.state.position.size(); ++i)
    EXPECT_LT(norm(with.rates.acceleration[i] - without.rates.acceleration[i]),
              1e-11 * (1 + norm(without.rates.acceleration[i])));
}

TEST(Stabilise, VelocitiesThatAreLinearArePushedAsWithout) {
  expect_no_damping(free_block(6, 5, 7), {1, -2, 0.5, 3, -1, 0.25, 0.75, 2, -0.5});
}

TEST(Stabilise, VelocitiesThatAreLinearStayBetweenMirrorsAndBehindThem) {
  expect_no_damping(block_between_mirrors(2), {1, 0, 0, 0, -2, 0, 0, 0, 3});
}

TEST(Stabilise, VelocitiesThatAlternateDecay) {
  Parameters p = endless();
  p.sph.hourglass_damping = 0.1;
  Stabilised e(p);
  // Seen by the velocity gradient as no motion at all.
  e.velocity([](const Vector3& x) { return Vector3{0, 0, 1e-3 * alternating(x)}; });
  double last = 1e-3;
  for (int k = 0; k < 10; ++k) {
    e.evaluate();
    double most = 0;
    for (std::size_t i = 0; i < e.rates.velocity_gradient.size(); ++i)
      EXPECT_LT(norm(symmetric_part(e.rates.velocity_gradient[i])), 1e-12);
    for (std::size_t i = 0; i < e.state.velocity.size(); ++i) {
      e.state.velocity[i] += 2e-4 * e.rates.acceleration[i];
      most = std::max(most, norm(e.state.velocity[i]));
    }
    EXPECT_LT(most, 0.95 * last);
    last = most;
  }
  // Grains that bear no pressure are left alone.
  e.pressure(0);
  e.evaluate();
  for (const Vector3& a : e.rates.acceleration) EXPECT_EQ(a, Vector3{});
}

TEST(Stabilise, KeepMomentumToRoundOff) {
  Parameters p = free_block(6, 5, 7);
  p.sph.smoothing = Smoothing::local;
  p.sph.viscosity_alpha = 0.1;
  p.sph.viscosity_speed = ViscositySpeed::local;
  p.sph.hourglass_damping = 0.1;
  p.sph.density_diffusion = 0.1;
  Stabilised e(p);
  e.disturb(0.3);
  e.randomise(0.8);
  e.evaluate();
  Vector3 total;
  double size = 0;
  for (const Vector3& a : e.rates.acceleration) total += a, size += norm(a);
  EXPECT_LT(norm(total), 1e-13 * size);
}

TEST(Stabilise, HaveTheSameBitsForAnyNumberOfThreadsAndResumed) {
  for (const Method method : {Method::runge_kutta, Method::leapfrog}) {
    Parameters p = small_hopper();
    p.sph.hourglass_damping = 0.1;
    p.sph.density_diffusion = 0.1;
    p.integration.method = method;
    expect_same_for_any_threads_and_resumed(p, 200);
    ThreadTeam team(2);
    Continuum model = started(p, team);
    model.advance(team);
    EXPECT_GT(norm(tensor_at(model.state().deformation_rate, 0)), 0) << "there is something to be kept";
  }
}

TEST(Stabilise, TheLocalSpeedIsTheLargestUnderPressureAndNoneApart) {
  Parameters p = free_block(6, 5, 7);
  p.sph.viscosity_alpha = 0.1;
  Stabilised largest(p);
  p.sph.viscosity_speed = ViscositySpeed::local;
  Stabilised local(p);
  Random random(5);
  largest.velocity([&](const Vector3&) { return Vector3{random.uniform(-1, 1), random.uniform(-1, 1), 0}; });
  local.state.velocity = largest.state.velocity;
  largest.evaluate();
  local.evaluate();
  EXPECT_EQ(local.rates.acceleration, largest.rates.acceleration);
  for (Stabilised* e : {&largest, &local}) e->pressure(0), e->evaluate();
  EXPECT_GT(norm(largest.rates.acceleration[0]), 1);
  for (const Vector3& a : local.rates.acceleration) EXPECT_EQ(norm(a), 0);
}

}  // namespace
}  // namespace talus::continuum
