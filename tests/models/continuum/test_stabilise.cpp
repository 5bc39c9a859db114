// SPDX-License-Identifier: Apache-2.0
/// The stabilisers of the sums: linear fields stay, what alternates decays, momentum is kept, and without them nothing
/// changes.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "cases.hpp"
#include "models/continuum/sweep.hpp"

namespace talus::continuum {
namespace {

struct Stabilised {
  ThreadTeam team{2};
  Parameters parameters;
  Material material;
  State state;
  Domain domain;
  Sweep sweep;
  Rates rates;

  explicit Stabilised(const Parameters& p)
      : parameters(p),
        material(p),
        state(initial_state(p, material)),
        domain(domain_of(p)),
        sweep(p, domain, state.mass, 50) {
    load(1000);
  }
  void load(double pressure) {
    for (std::size_t c = 0; c < 3; ++c) state.material.stress[c].assign(state.position.size(), pressure);
  }
  void disturb(double share) {
    Random random(3);
    for (Vector3& x : state.position)
      x += share * spacing * Vector3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  }
  void evaluate() {
    std::vector<double> h;
    for (const double density : state.density) h.push_back(sweep.smoothing_length(density));
    sweep.find_neighbours(team, state.position, h);
    sweep(team, {state.position, state.velocity, state.density, state.material}, SweepTerms::all, rates);
  }
};

/// Lattice without ends.
Parameters endless() {
  Parameters p = column(6, 6, 6);
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::periodic;
  return p;
}

/// 1 and -1 from particle to particle of a lattice.
double alternating(const Vector3& x) {
  const auto n = [](double place) { return static_cast<int>(std::floor(place / spacing)); };
  return (n(x.x) + n(x.y) + n(x.z)) % 2 == 0 ? 1 : -1;
}

TEST(Stabilise, DensitiesThatAreLinearStay) {
  Parameters p = free_block(6, 5, 7);
  p.sph.density_diffusion = 0.1;
  Stabilised e(p);
  e.disturb(0.2);
  double variation = 0;
  for (std::size_t i = 0; i < e.state.position.size(); ++i) {
    const Vector3& x = e.state.position[i];
    e.state.density[i] = 1500 + 2000 * (x.x - 0.5) - 1500 * x.y + 900 * (x.z - 5);
    variation = std::max(variation, std::abs(e.state.density[i] - 1500));
  }
  e.evaluate();
  // A jump of that size would fade at the rate 2 delta c/spacing.
  const double scale = variation * 2 * 0.1 * 50 / spacing;
  for (const double rate : e.rates.density_rate) EXPECT_LT(std::abs(rate), 1e-11 * scale);
}

TEST(Stabilise, DensitiesThatAlternateDecayAndTheirMeanStays) {
  Parameters p = endless();
  p.sph.density_diffusion = 0.1;
  Stabilised e(p);
  for (std::size_t i = 0; i < e.state.density.size(); ++i) e.state.density[i] = 1500 + alternating(e.state.position[i]);
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
  for (std::size_t i = 0; i < e.state.density.size(); ++i)
    e.state.density[i] = alternating(e.state.position[i]) > 0 ? 1500 : 1200;
  e.evaluate();
  for (const double rate : e.rates.density_rate) EXPECT_NEAR(rate, 0, 1e-8);  // a jump of 300 would fade at 3e5
}

TEST(Stabilise, VelocitiesThatAreLinearArePushedAsWithout) {
  Parameters p = free_block(6, 5, 7);
  Stabilised without(p);
  p.sph.hourglass_damping = 0.3;
  Stabilised with(p);
  for (Stabilised* e : {&without, &with}) {
    e->disturb(0.2);
    for (std::size_t i = 0; i < e->state.position.size(); ++i) {
      const Vector3& x = e->state.position[i];
      e->state.velocity[i] = {x.x - 2 * x.y + 0.5 * x.z, 3 * x.x - x.y + 0.25 * x.z, 0.75 * x.x + 2 * x.y - 0.5 * x.z};
    }
    e->evaluate();
  }
  for (std::size_t i = 0; i < with.state.position.size(); ++i)
    EXPECT_LT(norm(with.rates.acceleration[i] - without.rates.acceleration[i]),
              1e-11 * (1 + norm(without.rates.acceleration[i])));
}

TEST(Stabilise, VelocitiesThatAreLinearStayBetweenMirrorsAndBehindThem) {
  Parameters p = column(6, 2, 6, 4);
  p.box.right = p.box.rear = FaceKind::open;
  p.box.width *= 2;
  p.bed.left = 0;
  p.bed.right = 6 * spacing;
  Stabilised without(p);
  p.sph.hourglass_damping = 0.3;
  Stabilised with(p);
  for (Stabilised* e : {&without, &with}) {
    e->disturb(0.2);
    for (std::size_t i = 0; i < e->state.position.size(); ++i) {
      const Vector3& x = e->state.position[i];
      e->state.velocity[i] = {x.x, -2 * x.y, 3 * x.z};
    }
    e->evaluate();
  }
  for (std::size_t i = 0; i < with.state.position.size(); ++i)
    EXPECT_LT(norm(with.rates.acceleration[i] - without.rates.acceleration[i]),
              1e-11 * (1 + norm(without.rates.acceleration[i])));
}

TEST(Stabilise, VelocitiesThatAlternateDecay) {
  Parameters p = endless();
  p.sph.hourglass_damping = 0.1;
  Stabilised e(p);
  // Seen by the velocity gradient as no motion at all.
  for (std::size_t i = 0; i < e.state.velocity.size(); ++i)
    e.state.velocity[i] = {0, 0, 1e-3 * alternating(e.state.position[i])};
  double last = 1e-3;
  for (int k = 0; k < 10; ++k) {
    e.evaluate();
    double most = 0;
    for (const Tensor3<>& gradient : e.rates.velocity_gradient) EXPECT_LT(norm(symmetric_part(gradient)), 1e-12);
    for (std::size_t i = 0; i < e.state.velocity.size(); ++i) {
      e.state.velocity[i] += 2e-4 * e.rates.acceleration[i];
      most = std::max(most, norm(e.state.velocity[i]));
    }
    EXPECT_LT(most, 0.95 * last);
    last = most;
  }
  // Grains that bear no pressure are left alone.
  e.load(0);
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
  Random random(5);
  for (std::size_t i = 0; i < e.state.position.size(); ++i) {
    e.state.density[i] *= random.uniform(0.8, 1.1);
    e.state.velocity[i] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    for (auto& column : e.state.material.stress) column[i] = random.uniform(-1000, 1000);
  }
  e.evaluate();
  Vector3 total;
  double size = 0;
  for (const Vector3& a : e.rates.acceleration) total += a, size += norm(a);
  EXPECT_LT(norm(total), 1e-13 * size);
}

TEST(Stabilise, TheLocalSpeedIsTheLargestUnderPressureAndNoneApart) {
  Parameters p = free_block(6, 5, 7);
  p.sph.viscosity_alpha = 0.1;
  Stabilised largest(p);
  p.sph.viscosity_speed = ViscositySpeed::local;
  Stabilised local(p);
  Random random(5);
  for (std::size_t i = 0; i < local.state.velocity.size(); ++i)
    largest.state.velocity[i] = local.state.velocity[i] = {random.uniform(-1, 1), random.uniform(-1, 1), 0};
  largest.evaluate();
  local.evaluate();
  EXPECT_EQ(local.rates.acceleration, largest.rates.acceleration);
  for (Stabilised* e : {&largest, &local}) e->load(0), e->evaluate();
  EXPECT_GT(norm(largest.rates.acceleration[0]), 1);
  for (const Vector3& a : local.rates.acceleration) EXPECT_EQ(norm(a), 0);
}

}  // namespace
}  // namespace talus::continuum
