// SPDX-License-Identifier: Apache-2.0
/// Beds of grains that stick together: under tension, at walls, on slopes (docs/design/stabilisation.md, walls.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/unit.hpp"
#include "models/continuum/cases.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

constexpr double friction = 0.5;  // M

/// Perfectly plastic grains of one strength, Pa.
void make_cohesive(Parameters& p, double tensile_strength) {
  p.law = granular::CriticalState::Parameters{.bulk_modulus = 6e6,
                                              .shear_modulus = 3.6e6,
                                              .static_friction = friction,
                                              .dynamic_friction = friction,
                                              .packing_slope = 0,
                                              .dilatancy = 0,
                                              .ageing_strength = 0,
                                              .tensile_strength = tensile_strength};
  p.sph.viscosity_alpha = 0.1;
  p.sph.smoothing = Smoothing::local;
  p.integration.method = Method::leapfrog;
  p.integration.courant = default_courant(Method::leapfrog);
  p.settle.damping_time = 5e-3;
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.1;
}

double weight_of(double height) {
  return 1500 * 9.81 * height;
}

/// How far the bed has fallen at most 0.4 s after it was hung up, m. \param strength of a bar in plane strain over the
/// stress of its weight
double fall_of_bar(double strength, double artificial_stress) {
  Parameters p = column(8, 1, 40);
  p.box = {.width = 20 * spacing, .depth = spacing, .height = 44 * spacing};
  p.box.left = p.box.right = p.box.floor = FaceKind::open;
  p.box.top = FaceKind::symmetry;
  p.bed.left = 6 * spacing, p.bed.right = 14 * spacing, p.bed.bottom = 4 * spacing;
  make_cohesive(p, strength * weight_of(40 * spacing) * (1 + friction) / (2 * friction));
  p.sph.artificial_stress = artificial_stress;
  EXPECT_TRUE(check(p).empty());
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const auto before = by_identity(model.state(), model.state().position);
  while (model.state().time < 0.4) model.advance(team);
  const auto after = by_identity(model.state(), model.state().position);
  double most = 0;
  for (std::size_t i = 0; i < after.size(); ++i) most = std::max(most, before[i].z - after[i].z);
  return most;
}

TEST(CohesiveBed, ABarHangsUpToItsStrengthByItsSprings) {
  EXPECT_LT(fall_of_bar(1.15, 1), 0.1 * spacing);
  EXPECT_GT(fall_of_bar(0.85, 1), spacing);
  EXPECT_GT(fall_of_bar(1.5, 0), spacing) << "without them particles pair up";
}

/// The mean speed at the end of a layer of eight particles on a slope, m/s.
double speed_on_slope(double tilt, double coefficient, double adhesion) {
  Parameters p = column(6, 1, 8, 4);
  p.box.left = p.box.right = FaceKind::periodic;
  p.box.top = FaceKind::open;
  make_cohesive(p, 20e3);
  p.walls.friction = Friction::coulomb;
  p.walls.friction_from = FrictionFrom::start;
  p.walls.coefficient = coefficient, p.walls.adhesion = adhesion;
  p.gravity.tilt = tilt;
  EXPECT_TRUE(check(p).empty());
  ThreadTeam team(2);
  Continuum model = started(p, team);
  while (model.state().time < 0.25) model.advance(team);
  double sum = 0;
  for (const Vector3& v : model.state().velocity) sum += v.x / static_cast<double>(model.state().velocity.size());
  const Vector3 error = momentum_error(model.state());
  EXPECT_LT(norm(error), 1e-9 * norm(model.state().gravity_impulse));
  return sum;
}

TEST(CohesiveBed, SlidesOnItsBaseWhereFrictionAndAdhesionEnd) {
  // tan(beta) = mu + a/(rho g h cos(beta)), a quarter of rho g h: 29.7 degrees.
  const double adhesion = 0.25 * weight_of(8 * spacing);
  EXPECT_LT(speed_on_slope(29 * degree, 0.3, adhesion), 1e-4);
  EXPECT_GT(speed_on_slope(31 * degree, 0.3, adhesion), 5e-3);
  EXPECT_GT(speed_on_slope(20 * degree, 0.3, 0), 5e-3);
}

TEST(CohesiveBed, LeavesAWallThatDoesNotHoldIt) {
  for (const double adhesion : {0.0, 20e3}) {
    Parameters p = column(4, 4, 4, 8);
    p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::symmetry;
    make_cohesive(p, 10e3);
    p.gate.opens = GateOpens::from_the_start;
    p.walls.friction = Friction::coulomb;
    p.walls.adhesion = adhesion, p.walls.coefficient = 1;
    p.bed.velocity = {{0, 0, 0.05}};
    p.gravity.acceleration = 1e-3;
    ThreadTeam team(1);
    Continuum model = started(p, team);
    while (model.state().time < 0.4) model.advance(team);
    double lowest = 1;
    for (const Vector3& x : model.state().position) lowest = std::min(lowest, x.z);
    if (adhesion > 0) {
      EXPECT_LT(lowest, 1 * spacing);
    } else {
      EXPECT_GT(lowest, 2 * spacing);
    }
  }
}

TEST(CohesiveBed, PullsAtAVesselAsFarAsItsWallHolds) {
  // A block that rises from a plate of a vessel: what its fields note is what the patch received, and ends at the pull
  // that the wall holds, adhesion over friction on each square of a particle.
  constexpr double adhesion = 50;
  Parameters p = room(6, 6, 12);
  p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::symmetry;
  make_cohesive(p, 10e3);
  p.vessel = {plate("floor", {-3, -3, 2}, {12, 0, 0}, {0, 12, 0})};
  p.bed.bottom = 2 * spacing, p.bed.height = 4 * spacing;
  p.gate.opens = GateOpens::from_the_start;
  p.walls.friction = Friction::coulomb;
  p.walls.friction_from = FrictionFrom::start;
  p.walls.adhesion = 7 * adhesion, p.walls.coefficient = 1;  // the part's own counts
  p.vessel[0].adhesion = adhesion;
  p.bed.velocity = {{0, 0, 0.05}};
  p.gravity.acceleration = 1e-3;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const double area = 36 * spacing * spacing;
  const SurfaceFields fields = load_fields(Layout(p));
  double most = 0, before = 0, last = 0;
  while (s.time < 0.02) {
    model.advance(team);
    double push = 0, received = 0;
    for (std::size_t n = 0; n < s.wall_loads.push.size(); ++n)
      push += s.wall_loads.push_of(fields, n), received += s.wall_loads.received_of(fields, n).z;
    EXPECT_NEAR(push, -received, 1e-6 * std::abs(received) + 1e-15);
    EXPECT_NEAR(received, vessel_impulse(s)[0].z, 1e-6 * std::abs(received) + 1e-15);
    if (s.time > last) most = std::max(most, (before - push) / (s.time - last) / area);
    before = push, last = s.time;
  }
  EXPECT_GT(most, 0.5 * adhesion);
  EXPECT_LT(most, 1.5 * adhesion);
}

TEST(CohesiveBed, ItsFreeSurfaceIsNoCrack) {
  Parameters p = column(4, 2, 8, 4);
  make_cohesive(p, 1000);
  ThreadTeam team(1);
  const Continuum model = started(p, team);
  for (const double density : model.state().density) EXPECT_EQ(density, bulk_density(p));
}

TEST(CohesiveBed, HasTheSameBitsForAnyNumberOfThreadsAndResumed) {
  Parameters p = small_hopper();
  make_cohesive(p, 50);
  p.law.of<granular::CriticalState>().consolidation_strength = 0.1;
  p.sph.stress_regularisation = 0.2;
  p.gate.time = 0.02;
  expect_same_for_any_threads_and_resumed(p, 400);
}

TEST(CohesiveBed, TellsWhereKeysHaveNoMeaning) {
  Parameters p = column(4, 2, 8, 4);
  p.gravity.tilt = 0.1;
  EXPECT_TRUE(check(p).empty());
  const auto is_refused = [](const Parameters& with) {
    const auto problems = check(with);
    return std::any_of(problems.begin(), problems.end(), [](const Problem& q) { return q.key == "gravity.tilt"; });
  };
  Parameters with_air = p, with_plate = p;
  with_air.air.enabled = true;
  EXPECT_TRUE(is_refused(with_air));
  with_plate.plate.height = 2 * spacing;
  EXPECT_TRUE(is_refused(with_plate));
  EXPECT_FALSE(has_cohesion(p)) << "an elastic body has none";
  EXPECT_EQ(artificial_stress(p), 0);
}

}  // namespace
}  // namespace talus::continuum
