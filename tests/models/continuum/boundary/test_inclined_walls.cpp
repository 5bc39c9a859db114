// SPDX-License-Identifier: Apache-2.0
/// Inclined walls: loads, friction, gates, and that nothing gets through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/continuum/block_on_incline.hpp"
#include "models/continuum/cases.hpp"

namespace talus::continuum {
namespace {

/// Grains without stiffness against shear: a liquid.
void make_liquid(Parameters& p) {
  p.law = granular::LinearElastic::Parameters{.lambda = 4e5, .shear_modulus = 1e2};
  p.sph.viscosity_alpha = 0.3;
}

TEST(InclinedWalls, BearTheHydrostaticLoadOfALiquid) {
  // A trough with one vertical wall and one inclined by 45 degrees, 12 spacings deep.
  Parameters p = column(30, 1, 24, 10);
  make_liquid(p);
  p.bed.height = 12 * spacing;
  p.plates = {{.from = {10 * spacing, 0}, .to = {30 * spacing, 20 * spacing}, .openings = {}, .opens_after = {}}};
  p.gate.opens = GateOpens::when_settled;
  p.settle = {.speed = 2e-2, .duration = 0.02, .max_time = 2, .loading_time = {}, .damping_time = 5e-3};
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto force = settled_wall_forces(model, team, 0.05);
  const double weight = s.mass * 9.81 * double(s.position.size());
  // Exact: the level of as much liquid, A = 10 H + H^2/2 spacings squared, H its depth.
  const double area = double(s.position.size()) * spacing * spacing;
  const double depth = -10 * spacing + std::sqrt(100 * spacing * spacing + 2 * area);
  const double sideways = 0.5 * bulk_density(p) * 9.81 * depth * depth * p.box.depth;
  const double upper = -(force[6].z + force[4].z);
  EXPECT_NEAR(upper, weight, 0.01 * weight) << "floor and inclined wall carry the weight";
  EXPECT_NEAR(force[6].x, sideways, 0.06 * sideways);
  EXPECT_NEAR(-force[0].x, sideways, 0.06 * sideways);
  EXPECT_NEAR(force[6].x, -force[0].x, 0.03 * sideways) << "nothing moves sideways";
  EXPECT_NEAR(force[6].x, -force[6].z, 1e-9 * sideways) << "along its normal";
  EXPECT_NEAR(-force[6].z, sideways, 0.06 * sideways) << "what stands above it";
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
  for (const Vector3& x : s.position) EXPECT_GT(x.z, x.x - 10 * spacing) << "a particle below the wall";
}

/// Acceleration along an incline of that angle, from the start of a run of a block that touches it.
double acceleration_down(double angle, double coefficient) {
  Parameters p = free_block(1, 1, 1);
  p.walls.friction = coefficient > 0 ? Friction::coulomb : Friction::none;
  p.walls.coefficient = coefficient;
  p.walls.friction_from = FrictionFrom::start;
  p.sph.viscosity_alpha = 0.3;
  const double x0 = 0.3, z0 = 5, length = 3;
  p.plates = {{.from = {x0, z0},
               .to = {x0 + length * std::cos(angle), z0 - length * std::sin(angle)},
               .openings = {},
               .opens_after = {}}};
  p.box.width = 3;
  p.bed = {};
  p.bed.packing = 0.6, p.bed.spacing = spacing, p.bed.height = spacing;
  p.bed.bottom = 9, p.bed.left = 0.5, p.bed.right = 0.5 + spacing;
  p.box.front = p.box.rear = FaceKind::periodic;
  ThreadTeam team(1);
  Continuum model(p);
  return acceleration_of_block(model, model.state(), {x0, 0, z0}, angle, team);
}

TEST(InclinedWalls, ABlockSlidesAsCoulombSays) {
  const double angle = 35 * half_turn / 180;
  const double smooth = 9.81 * std::sin(angle), rubbing = 9.81 * (std::sin(angle) - 0.3 * std::cos(angle));
  EXPECT_NEAR(acceleration_down(angle, 0), smooth, 1e-9 * smooth);
  // The block bounces a little: only where the wall pushes does it rub, and what pulls is pulled by elastic grains.
  EXPECT_NEAR(acceleration_down(angle, 0.3), rubbing, 0.05 * 9.81);
  EXPECT_NEAR(acceleration_down(angle, 0.9), 0, 0.01 * 9.81) << "it sticks";
}

TEST(InclinedWalls, NothingLeaksFromAWedge) {
  Parameters p = column(20, 1, 30, 10);
  make_granular(p);
  p.wedge = {.half_angle = half_turn / 6, .outlet = 6 * spacing, .height = 8 * spacing};
  p.bed.height = 16 * spacing;
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.05;
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const std::size_t count = s.position.size();
  ASSERT_GT(count, 150u);
  std::size_t passed = 0;
  while (s.time < 0.3) {
    const auto before = by_identity(s, s.position);
    Domain domain = Boundary(p).domain();
    if (s.gate_time >= 0) domain.open_gates();
    model.advance(team);
    const auto after = by_identity(s, s.position);
    passed = 0;
    for (std::size_t n = 0; n < count; ++n) {
      ASSERT_FALSE(domain.blocks(before[n], after[n]))
          << "at " << s.time << " from " << before[n].x << ' ' << before[n].z;
      ASSERT_TRUE(after[n].x >= 0 && after[n].x <= p.box.width && after[n].z >= 0);
      passed += after[n].z < p.wedge.height;
    }
    if (s.gate_time < 0) {
      ASSERT_EQ(passed, 0u);
    }
  }
  EXPECT_GT(passed, count / 8);
  EXPECT_EQ(s.position.size(), count);
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
}

TEST(Plates, EachHasItsOpeningsAndItsGate) {
  Parameters p = column(12, 1, 40);
  make_granular(p);
  p.bed.height = 6 * spacing;
  p.bed.bottom = 30 * spacing;
  p.plates = {{.from = {0, 28 * spacing},
               .to = {12 * spacing, 28 * spacing},
               .openings = {2 * spacing, 6 * spacing},
               .opens_after = 0.0},
              {.from = {0, 14 * spacing},
               .to = {12 * spacing, 14 * spacing},
               .openings = {6 * spacing, 10 * spacing},
               .opens_after = 0.15},
              // A partition between the two, along x.
              {.from = {6 * spacing, 0}, .to = {6 * spacing, 10 * spacing}, .openings = {}, .opens_after = {}}};
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.03;
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto lowest = [&] {
    return std::min_element(s.position.begin(), s.position.end(), [](auto& a, auto& b) { return a.z < b.z; })->z;
  };
  while (s.gate_time < 0) model.advance(team);
  EXPECT_GT(lowest(), 28 * spacing);
  while (s.time < s.gate_time + 0.149) {
    model.advance(team);
    ASSERT_GT(lowest(), 14 * spacing);
  }
  EXPECT_LT(lowest(), 24 * spacing);
  while (s.time < s.gate_time + 0.35) model.advance(team);
  EXPECT_LT(lowest(), 10 * spacing);
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
}

TEST(Wedge, IsSymmetricAndTheSameBitsOnOneAndTwoThreads) {
  Parameters p = column(16, 1, 24, 6);
  make_liquid(p);
  p.wedge = {.half_angle = half_turn / 6, .outlet = 4 * spacing, .height = 4 * spacing};
  p.bed.height = 12 * spacing;
  const auto run = [&](int threads) {
    ThreadTeam team(threads);
    Continuum model = started(p, team);
    while (model.state().time < 0.05) model.advance(team);
    return model;
  };
  const Continuum one = run(1), two = run(2);
  EXPECT_EQ(one.state().position, two.state().position);
  EXPECT_EQ(one.state().patch_impulse, two.state().patch_impulse);
  const auto& w = one.state().patch_impulse;
  EXPECT_NEAR(w[6].x, -w[7].x, 1e-6 * std::abs(w[6].z));
  EXPECT_NEAR(w[6].z, w[7].z, 1e-6 * std::abs(w[6].z));
}

}  // namespace
}  // namespace talus::continuum
