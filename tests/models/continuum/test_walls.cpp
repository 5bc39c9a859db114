// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases.hpp"

namespace talus::continuum {
namespace {

TEST(Walls, TheGateOpensAtItsTimeAndNothingPassesBefore) {
  Parameters p = small_hopper();
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.02;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  while (model.state().gate_time < 0) {
    model.advance(team);
    for (const Vector3& x : model.state().position) ASSERT_GT(x.z, *p.plate.height);
  }
  EXPECT_GE(model.state().gate_time, 0.02);
  EXPECT_LT(model.state().gate_time, 0.02 + 2 * model.state().last_step);
  while (model.state().time < 0.08) model.advance(team);
  EXPECT_LT(std::min_element(model.state().position.begin(), model.state().position.end(),
                             [](auto& a, auto& b) { return a.z < b.z; })
                ->z,
            *p.plate.height - spacing);
}

TEST(Walls, ALumpFallsPastThePlatesEdgeUntouchedAndBouncesOffThePlate) {
  Parameters p = column(12, 1, 1, 60);
  p.plate.height = 15 * spacing;
  p.plate.slit_left = 4 * spacing;
  p.plate.slit_right = 12 * spacing;
  p.bed.bottom = 25 * spacing;
  p.sph.smoothing = Smoothing::fixed;
  ThreadTeam team(1);
  const auto dropped_at = [&](double x) {
    Continuum model(p);
    State& s = model.mutable_state();
    const auto only = [&](auto& column) { column.resize(1); };
    only(s.position), only(s.velocity), only(s.density), only(s.identity);
    for (auto& column : s.material.stress) only(column);
    s.position[0] = {x, 0.5 * spacing, 16 * spacing};
    model.begin(team);
    while (model.state().time < 0.1) model.advance(team);
    return model;
  };
  // Beside the edge: free fall, although its images in the plate stand within reach of its side.
  Continuum free = dropped_at(4.05 * spacing);
  EXPECT_NEAR(free.state().position[0].z, 16 * spacing - 0.5 * 9.81 * std::pow(free.state().time, 2), 1e-3 * spacing);
  EXPECT_NEAR(free.state().position[0].x, 4.05 * spacing, 1e-12);
  // Over the plate: it meets its own image and stays above.
  Continuum held = dropped_at(3.95 * spacing);
  EXPECT_GT(held.state().position[0].z, 15 * spacing);
  EXPECT_LT(norm(momentum_error(held.state())), 1e-12 * norm(held.state().gravity_impulse));
  EXPECT_LT(held.state().wall_impulse[6].z, 0);
}

TEST(Walls, ABlockSlidesWithCoulombsFrictionAndSticksBelowIt) {
  Parameters p = column(40, 1, 4, 20);
  p.bed.left = 2 * spacing;
  p.bed.right = 12 * spacing;
  p.walls.friction = Friction::coulomb;
  p.walls.friction_from = FrictionFrom::gate;
  p.gate.opens = GateOpens::when_settled;
  p.settle.damping_time = 3e-3;
  p.settle.duration = 5e-3;
  p.settle.speed = 1e-3;
  p.sph.viscosity_alpha = 0.2;
  ThreadTeam team(2);
  Continuum model = started(p, team);
  while (model.state().gate_time < 0) model.advance(team);
  State& s = model.mutable_state();
  for (Vector3& v : s.velocity) v.x += 0.3;
  const auto mean = [&] { return momentum(s).x / (s.mass * double(s.position.size())); };
  const double begin = s.time;
  const Vector3 before = s.wall_impulse[4];
  while (s.time < begin + 0.05) model.advance(team);
  const Vector3 received = s.wall_impulse[4] - before;
  EXPECT_GT(mean(), 0.05) << "it slides still";
  // Elastic lumps at the block's ends are pulled by the floor now and then, and only those that it pushes rub.
  EXPECT_GT(received.x / -received.z, 0.299);
  EXPECT_LT(received.x / -received.z, 0.36);
  EXPECT_NEAR(-received.z, 40 * s.mass * 9.81 * (s.time - begin), 0.2 * 40 * s.mass * 9.81 * 0.05);
  while (s.time < begin + 0.25) model.advance(team);
  EXPECT_LT(std::abs(mean()), 2e-3);
  EXPECT_LT(norm(momentum_error(s) - Vector3{40 * s.mass * 0.3, 0, 0}), 1e-11 * norm(s.gravity_impulse));
}

}  // namespace
}  // namespace talus::continuum
