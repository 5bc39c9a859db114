// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/continuum/cases.hpp"
#include "physics/sph/wall_contact.hpp"

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

TEST(Walls, AParticleFallsPastThePlatesEdgeUntouchedAndNotIntoThePlate) {
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
  // Over the plate: elastic grains swing on their own image, no nearer than the contact distance.
  Continuum held = dropped_at(3.95 * spacing);
  EXPECT_GT(held.state().position[0].z, (15 + sph::contact_distance - 1e-3) * spacing);
  EXPECT_LT(norm(momentum_error(held.state())), 1e-12 * norm(held.state().gravity_impulse));
  EXPECT_LT(held.state().patch_impulse[6].z, 0);
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
  const Vector3 before = s.patch_impulse[4];
  while (s.time < begin + 0.05) model.advance(team);
  const Vector3 received = s.patch_impulse[4] - before;
  EXPECT_GT(mean(), 0.05) << "it slides still";
  // Elastic particles at the block's ends are pulled by the floor now and then, and only those that it pushes rub.
  EXPECT_GT(received.x / -received.z, 0.299);
  EXPECT_LT(received.x / -received.z, 0.36);
  EXPECT_NEAR(-received.z, 40 * s.mass * 9.81 * (s.time - begin), 0.2 * 40 * s.mass * 9.81 * 0.05);
  while (s.time < begin + 0.25) model.advance(team);
  EXPECT_LT(std::abs(mean()), 2e-3);
  EXPECT_LT(norm(momentum_error(s) - Vector3{40 * s.mass * 0.3, 0, 0}), 1e-11 * norm(s.gravity_impulse));
}

/// cases/janssen-silo.toml with particles twice as large. Janssen: between walls a width W apart that rub with mu the
/// floor carries L/H (1 - exp(-H/L)) of a bed of height H, L = W/(2 mu K), K the force on a wall over what the vertical
/// stress would exert on it.
TEST(Walls, HoldTheGrainsOfASiloAsJanssenSaid) {
  Parameters p = as_printed();
  p.box = {.width = 30e-3, .depth = 5e-3, .height = 180e-3};
  p.bed.spacing = 5e-3;
  p.bed.height = 150e-3;
  p.law = granular::YuuUmekageIsotropic::Parameters{.fits = {.scale = 1.5}};
  p.walls.coefficient = 0.3;
  p.walls.friction_from = FrictionFrom::start;
  p.settle.damping_time = 5e-3;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto force = settled_wall_forces(model, team, 0.02);
  const Vector3 left = force[0], right = force[1], floor = force[4];
  const double weight = s.mass * static_cast<double>(s.position.size()) * 9.81;
  EXPECT_NEAR(-(left.z + right.z + floor.z) / weight, 1, 0.005);
  EXPECT_NEAR(left.z, right.z, 1e-6 * weight);
  EXPECT_NEAR(left.z / left.x, 0.3, 0.006) << "friction is mobilised";

  double stress = 0;
  for (const double szz : s.material.stress[2]) stress += szz;
  const double over_wall = stress * std::pow(p.bed.spacing, 3) / p.box.width;  // N
  const double k = -left.x / over_wall;
  EXPECT_GT(k, 0.4);
  EXPECT_LT(k, 0.6);
  const double length = p.box.width / (2 * 0.3 * k), height = 150e-3;
  const double janssen = length / height * (1 - std::exp(-height / length));
  EXPECT_NEAR(-floor.z / weight, janssen, 0.05 * janssen);
}

/// What leaves through an open face is counted there, and what is inside with it is what there was: to the last
/// particle.
TEST(Totals, CountTheMassThatHasLeftThroughAnOpenFace) {
  Parameters p = small_hopper();
  p.box.floor = FaceKind::open;
  p.plate.height = 6 * spacing;
  p.box.height = 30 * spacing;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto total = [&](std::string_view name) {
    for (const NamedValue& value : model.totals())
      if (value.name == name) return value.value;
    ADD_FAILURE() << name;
    return 0.0;
  };
  const std::size_t particles = s.position.size();
  const double initial = s.mass * static_cast<double>(particles);
  EXPECT_EQ(total("mass_outside"), 0);
  double outside = 0;
  while (s.time < 0.25) {
    model.advance(team);
    std::size_t inside = 0;
    for (const Vector3& x : s.position)
      inside += x.z >= 0 && x.z <= p.box.height && x.x >= 0 && x.x <= p.box.width && x.y >= 0 && x.y <= p.box.depth;
    ASSERT_EQ(s.position.size(), particles);
    ASSERT_EQ(total("mass_outside"), s.mass * static_cast<double>(particles - inside));
    ASSERT_GE(total("mass_outside"), outside) << "what has left does not come back";
    outside = total("mass_outside");
    ASSERT_NEAR(s.mass * static_cast<double>(inside) + outside, initial, 1e-12 * initial);
  }
  EXPECT_GT(outside, 10 * s.mass);
  EXPECT_LT(outside, initial - 20 * s.mass);
  std::vector<std::int64_t> identities = s.identity;
  std::sort(identities.begin(), identities.end());
  for (std::size_t n = 0; n < particles; ++n)
    ASSERT_EQ(identities[n], static_cast<std::int64_t>(n)) << "each particle once";
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
}

}  // namespace
}  // namespace talus::continuum
