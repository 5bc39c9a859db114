// SPDX-License-Identifier: Apache-2.0
/// Air in a vessel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "models/continuum/cases.hpp"
#include "models/continuum/setup/vessel.hpp"
#include "models/continuum/step.hpp"

namespace talus::continuum {
namespace {

VesselPart part(const char* name, VesselShape shape) {
  VesselPart v;
  v.name = name, v.shape = shape;
  return v;
}

/// A cylinder with a hole in its floor, shut by a gate until 10 ms; a bin of air below it.
Parameters cylinder_in_air() {
  Parameters p = column(14, 14, 8, 12);
  make_granular(p);
  p.bed.bottom = 8 * spacing;
  p.bed.height = 8 * spacing;
  VesselPart wall = part("wall", VesselShape::cylinder), floor = part("ring", VesselShape::disc),
             gate = part("gate", VesselShape::disc);
  wall.radius = floor.radius = 6 * spacing;
  wall.bottom = floor.height = gate.height = 8 * spacing, wall.top = 19 * spacing;
  floor.hole = gate.radius = 4 * spacing, gate.gate = true, gate.opens_after = 0.01;
  p.vessel = {wall, floor, gate};
  p.integration.method = Method::leapfrog;
  p.air.enabled = true;
  p.air.cell = spacing;
  return p;
}

double air_speed_below(const State& s, double height) {
  double fastest = 0;
  const Grid& grid = s.air.grid;
  for (int k = 0; grid.centre(0, 0, k).z < height; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i)
        for (int axis = 0; axis < 3; ++axis)
          fastest = std::max(fastest, std::abs(s.air.flow.cell_velocity(grid, axis, grid.index(i, j, k))));
  return fastest;
}

TEST(VesselInAir, MomentumIsExchangedAndTheGateLetsTheAirThrough) {
  const Parameters p = cylinder_in_air();
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const std::size_t particles = s.position.size();
  while (s.time < 0.009) model.advance(team);
  EXPECT_LT(air_speed_below(s, 7 * spacing), 1e-6) << "the vessel is tight";
  while (s.time < 0.06) model.advance(team);
  EXPECT_GT(air_speed_below(s, 7 * spacing), 0.02);
  EXPECT_EQ(s.position.size(), particles);
  EXPECT_GT(std::count_if(s.position.begin(), s.position.end(), [](const Vector3& x) { return x.z < 8 * spacing; }), 5);
  EXPECT_GT(norm(s.air.impulse), 1e-3 * norm(s.gravity_impulse));
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
  for (std::size_t c = 0; c < s.air.solids.fraction.size(); ++c) ASSERT_LT(s.air.solids.fraction[c], 0.64 + 1e-12);
}

/// The air's upward impulse on the grains over their weight's, and the share of them that has left, after a time.
std::array<double, 2> held_back_and_left(const Parameters& p, double height, double duration) {
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.time < duration) model.advance(team);
  const auto left = std::count_if(s.position.begin(), s.position.end(), [&](const Vector3& x) { return x.z < height; });
  return {-s.air.impulse.z / s.gravity_impulse.z, static_cast<double>(left) / static_cast<double>(s.position.size())};
}

TEST(VesselInAir, PlatesOfTrianglesDoWhatAPlateDoes) {
  Parameters p = column(16, 3, 14, 22);
  make_granular(p);
  p.box.front = p.box.rear = FaceKind::symmetry;
  p.integration.method = Method::leapfrog;
  p.air.enabled = true;
  p.air.cell = spacing;
  p.bed.bottom = 12 * spacing;
  p.plate.height = 12 * spacing, p.plate.slit_left = 4 * spacing, p.plate.slit_right = 12 * spacing;
  Parameters q = p;
  q.plate = {};
  for (const double x : {-2.0, 12.0}) {
    VesselPart plate = part(x < 0 ? "west" : "east", VesselShape::plate);
    plate.corner = {x * spacing, -spacing, 12 * spacing};
    plate.first_edge = {6 * spacing, 0, 0}, plate.second_edge = {0, 5 * spacing, 0};
    q.vessel.push_back(plate);
  }
  const auto straight = held_back_and_left(p, 12 * spacing, 0.12),
             triangles = held_back_and_left(q, 12 * spacing, 0.12);
  EXPECT_NEAR(triangles[0] / straight[0], 1, 0.03);
  EXPECT_NEAR(triangles[1] / straight[1], 1, 0.1);
}

TEST(VesselInAir, AnyNumberOfThreadsHasTheSameBits) {
  const Parameters p = cylinder_in_air();
  ThreadTeam one(1), three(3);
  Continuum a = started(p, one), b = started(p, three);
  while (a.state().time < 0.013) a.advance(one), b.advance(three);
  EXPECT_EQ(a.state().position, b.state().position);
  EXPECT_EQ(a.state().air.flow.velocity, b.state().air.flow.velocity);
}

TEST(VesselInAir, WallsThatMoveAreRefused) {
  Parameters p = cylinder_in_air();
  p.vessel[0].spin = 1;
  std::vector<std::string> keys;
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  EXPECT_THAT(keys, testing::Contains("air.enabled"));
  p = cylinder_in_air();
  p.box.front = FaceKind::symmetry;
  p.air.gas.boundaries.kind[2] = FlowBoundary::no_slip;
  keys.clear();
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  EXPECT_THAT(keys, testing::ElementsAre("air.front"));
}

}  // namespace
}  // namespace talus::continuum
