// SPDX-License-Identifier: Apache-2.0
/// A vessel that ends at planes of symmetry or at walls of the box: these bear what the images behind them push.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/continuum/cases.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

using std::numbers::pi;

constexpr double radius = 7;  // spacings

/// A quarter of a silo with a flat bottom and a round gate; its axis is an edge of the box.
Parameters quarter(FaceKind faces) {
  Parameters p = room(9, 9, 30);
  p.box.left = p.box.front = faces;
  VesselPart cylinder = named("cylinder", VesselShape::cylinder);
  cylinder.radius = radius * spacing, cylinder.bottom = 10 * spacing, cylinder.top = 28 * spacing;
  VesselPart bottom = disc("bottom", radius, 10), gate = disc("gate", 3, 10);
  bottom.hole = 3 * spacing;
  gate.gate = true;
  p.vessel = {cylinder, bottom, gate};
  for (VesselPart& part : p.vessel) part.centre = {0, 0};
  p.bed.bottom = 10 * spacing, p.bed.height = 10 * spacing;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  return p;
}

void expect_closed(const State& s, const char* when) {
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse)) << when;
}

TEST(VesselSymmetry, MomentumClosesAtRestAndInFlow) {
  for (const FaceKind faces : {FaceKind::symmetry, FaceKind::wall}) {
    Parameters p = quarter(faces);
    make_granular(p);
    p.walls.friction_from = FrictionFrom::start;
    p.gate.opens = GateOpens::at_time;
    p.gate.time = 0.03;
    ASSERT_THAT(check(p), testing::IsEmpty());
    ThreadTeam team(2);
    Continuum model = started(p, team);
    const State& s = model.state();
    ASSERT_GT(s.position.size(), 300u);
    while (s.gate_time < 0) model.advance(team);
    expect_closed(s, "at rest");
    while (s.time < 0.08) model.advance(team);
    expect_closed(s, "in flow");
    EXPECT_LT(s.patch_impulse[0].x, -0.05 * norm(s.gravity_impulse)) << "the planes bear a load";
    EXPECT_NEAR(s.patch_impulse[0].x, s.patch_impulse[2].y, 0.2 * std::abs(s.patch_impulse[0].x));
  }
}

TEST(VesselSymmetry, PlanesBearWhatTheOtherHalfWould) {
  Parameters p = quarter(FaceKind::symmetry);
  p.vessel.pop_back();
  p.vessel.back().hole = 0;
  p.law = granular::LinearElastic::Parameters{.lambda = 2e5, .shear_modulus = 1e2};
  p.sph.viscosity_alpha = 0.3;
  p.gate.opens = GateOpens::when_settled;
  p.settle = {.speed = 2e-2, .duration = 0.01, .max_time = 2, .loading_time = {}, .damping_time = 5e-3};
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto face = settled_wall_forces(model, team, 0.03);
  const double depth =
      s.mass * double(s.position.size()) / (bulk_density(p) * 0.25 * pi * std::pow(radius * spacing, 2));
  const double sideways = 0.5 * bulk_density(p) * 9.81 * depth * depth * radius * spacing;
  EXPECT_NEAR(-face[0].x, sideways, 0.05 * sideways);
  EXPECT_NEAR(-face[2].y, sideways, 0.05 * sideways);
  expect_closed(s, "settled");
}

double mean_stress(const State& s, std::size_t i) {
  return (s.material.stress[0][i] + s.material.stress[1][i] + s.material.stress[2][i]) / 3;
}

/// In the lowest layer of a bed on a plate, which ends at the faces or goes on beyond them, Pa.
double min_pressure_on_plate(FaceKind faces, double beyond) {
  Parameters p = room(8, 8, 20);
  make_granular(p);
  p.law = granular::CriticalState::Parameters{.bulk_modulus = 2e5, .shear_modulus = 1.2e5, .reference_packing = 0.6};
  p.box.left = p.box.right = p.box.front = p.box.rear = faces;
  const double edge = 8 + 2 * beyond;
  p.vessel = {plate("ground", {-beyond, -beyond, 3}, {edge, 0, 0}, {0, edge, 0})};
  p.bed.bottom = 3 * spacing, p.bed.height = 8 * spacing;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  EXPECT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.time < 0.4) model.advance(team);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (s.position[i].z < 4 * spacing) least = std::min(least, mean_stress(s, i));
  return least;
}

TEST(VesselSymmetry, AWallThatEndsAtAFaceHoldsParticlesAsOneThatGoesOn) {
  for (const FaceKind faces : {FaceKind::symmetry, FaceKind::periodic, FaceKind::wall}) {
    const double whole = min_pressure_on_plate(faces, 6);
    for (const double beyond : {0.0, 0.4})
      EXPECT_NEAR(min_pressure_on_plate(faces, beyond), whole, 0.03 * whole) << choice_name(faces) << beyond;
  }
}

}  // namespace
}  // namespace talus::continuum
