// SPDX-License-Identifier: Apache-2.0
/// Belts and turning walls: what they take along.
#include "models/continuum/boundary/boundary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/cases.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

/// A layer of grains, periodic along x and y, on a floor of friction 0.2.
Parameters layer_on_a_floor() {
  Parameters p = column(6, 6, 4, 8);
  make_granular(p);
  p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::periodic;
  p.box.floor = FaceKind::open;
  p.walls.coefficient = 0.2;
  p.walls.friction_from = FrictionFrom::start;
  p.vessel = {plate("bottom", {-4, -4, 2}, {14, 0, 0}, {0, 14, 0})};
  p.bed.bottom = 2 * spacing;
  return p;
}

TEST(VesselMotion, ABeltTakesALayerAlongAsCoulombSays) {
  Parameters p = layer_on_a_floor();
  p.vessel[0].belt = {0.3, 0.1, 0};
  const double speed = std::hypot(0.3, 0.1);
  for (const Method method : {Method::runge_kutta, Method::leapfrog}) {
    p.integration.method = method;
    ThreadTeam team(1);
    Continuum model = started(p, team);
    const State& s = model.state();
    const double mass = s.mass * double(s.position.size());
    while (s.time < 0.1) model.advance(team);
    const Vector3 halfway = (1 / mass) * momentum(s);
    EXPECT_NEAR(std::hypot(halfway.x, halfway.y), 0.2 * 9.81 * s.time, 0.02 * speed);
    EXPECT_NEAR(halfway.y / halfway.x, 1.0 / 3, 0.01) << "in the direction of the belt";
    while (s.time < 0.25) model.advance(team);
    const Vector3 at_the_end = (1 / mass) * momentum(s);
    EXPECT_NEAR(at_the_end.x, 0.3, 0.01 * speed) << "with the belt since 0.161 s";
    EXPECT_NEAR(at_the_end.y, 0.1, 0.01 * speed);
    EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
  }
}

TEST(VesselMotion, ABeltStandsUntilTheGateOpens) {
  Parameters p = layer_on_a_floor();
  p.vessel[0].belt = {0.3, 0, 0};
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.02;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.gate_time < 0) model.advance(team);
  const double mass = s.mass * double(s.position.size());
  EXPECT_LT(std::abs(momentum(s).x), 1e-6 * mass);
  const double begin = s.time;
  while (s.time < begin + 0.05) model.advance(team);
  EXPECT_NEAR(momentum(s).x / mass, 0.2 * 9.81 * (s.time - begin), 0.02 * 0.3);
}

/// A drum along y, its walls turning.
Parameters drum(Along along, double spin) {
  Parameters p = along == Along::y ? room(20, 8, 20) : room(8, 20, 20);
  make_granular(p);
  VesselPart shell = named("shell", VesselShape::cylinder);
  shell.along = along;
  shell.radius = 8 * spacing, shell.bottom = 2 * spacing, shell.top = 6 * spacing;
  VesselPart ends[2] = {disc("near", 8, 2), disc("far", 8, 6)};
  for (VesselPart& end : ends) end.along = along, end.friction = 0;
  p.vessel = {shell, ends[0], ends[1]};
  for (VesselPart& part : p.vessel) part.spin = spin;
  p.bed.height = 5 * spacing;
  p.walls.coefficient = 0.3;
  p.walls.friction_from = FrictionFrom::start;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  return p;
}

TEST(VesselMotion, TheWallOfADrumMovesAlongItselfAtItsRim) {
  for (const Along along : {Along::y, Along::x}) {
    const Parameters p = drum(along, 3);
    ASSERT_THAT(check(p), testing::IsEmpty());
    const Vector3 axis = along == Along::y ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
    const Vector3 middle{10 * spacing, 10 * spacing, 10 * spacing};
    std::size_t seen = 0;
    const Boundary boundary(p);
    const Surface& surface = boundary.vessel();
    const WallMotion motion = boundary.patches()[boundary.patch_of_part(0)].motion.value();
    for (const Triangle& t : surface.triangles()) {
      if (t.patch != 0) continue;
      const Vector3 x = (1.0 / 3) * (t.corner[0] + t.corner[1] + t.corner[2]);
      Vector3 arm = x - middle;
      arm -= dot(arm, axis) * axis;
      EXPECT_NEAR(norm(arm), 8 * spacing, 0.05 * spacing);
      const Vector3 u = motion.at(x);
      EXPECT_LT(norm(u - 3.0 * cross(axis, arm)), 1e-12);
      ++seen;
    }
    EXPECT_GT(seen, 40u);
  }
}

TEST(VesselMotion, ATubeMayTurnAndSlideAtOnce) {
  Parameters p = drum(Along::y, 3);
  p.vessel[0].slide = 0.2;
  ASSERT_THAT(check(p), testing::IsEmpty());
  const Vector3 beside{12 * spacing, 4 * spacing, 10 * spacing};  // 2 spacings from the axis, along x
  const Boundary boundary(p);
  const WallMotion motion = boundary.patches()[boundary.patch_of_part(0)].motion.value();
  EXPECT_LT(norm(motion.at(beside) - Vector3{0, 0.2, -3 * 2 * spacing}), 1e-12);
}

TEST(VesselMotion, ALyingTubeThatSlidesTakesItsBedAlong) {
  // A bed on the lowest part of the wall of a pipe along x. What presses on the wall is its weight at least, which a
  // round wall bears with more than that, so that it takes up the speed of the pipe within speed / (mu g).
  Parameters p = room(8, 20, 20);
  make_granular(p);
  p.box.left = p.box.right = FaceKind::periodic;
  VesselPart pipe = named("pipe", VesselShape::cylinder);
  pipe.along = Along::x;
  pipe.radius = 8 * spacing, pipe.bottom = -2 * spacing, pipe.top = 10 * spacing;
  pipe.slide = 0.15;
  p.vessel = {pipe};
  p.bed.height = 3 * spacing;
  p.walls.coefficient = 0.3;
  p.walls.friction_from = FrictionFrom::start;
  ASSERT_THAT(check(p), testing::IsEmpty());
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const double mass = s.mass * double(s.position.size()), begin = s.time, slowest = 0.15 / (0.3 * 9.81);
  while (s.time < begin + 0.5 * slowest) model.advance(team);
  EXPECT_GT(momentum(s).x / mass, 0.95 * 0.3 * 9.81 * (s.time - begin));
  EXPECT_LT(momentum(s).x / mass, 0.15);
  while (s.time < begin + 2 * slowest) model.advance(team);
  EXPECT_NEAR(momentum(s).x / mass, 0.15, 0.01 * 0.15);
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
}

TEST(VesselMotion, ADrumCarriesItsBedUpAsFarAsFrictionHoldsIt) {
  // The bed slides along the wall, which turns faster, and swings about the place where its weight, at the distance r
  // from the axis and an angle theta to the side, balances the friction at the radius R: r sin(theta) = R sin(phi) for
  // a bed on a short arc of the wall, somewhat more on a long one. Spinning about +y, the lowest wall moves to -x.
  const Parameters p = drum(Along::y, 12);
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const double count = double(s.position.size());
  double lever = 0, samples = 0;
  while (s.time < 0.7) {
    model.advance(team);
    if (s.time < 0.1) continue;
    double x = 0;
    for (const Vector3& at : s.position) x += (at.x - 10 * spacing) / count;
    lever += x, ++samples;
  }
  const double expected = 8 * spacing * std::sin(std::atan(0.3));
  EXPECT_GT(-lever / samples, 0.8 * expected);
  EXPECT_LT(-lever / samples, 1.3 * expected);
  for (const Vector3& x : s.position)
    EXPECT_LT(std::hypot(x.x - 10 * spacing, x.z - 10 * spacing), 8.05 * spacing) << "none is lost";
  EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
}

/// Mean packing of the places over that of the densities, less 1, after a while of turning: of the particles farther
/// from the wall than its first layers, where the kernel's sum is a few per cent above that of a lattice.
double drift_in_drum(double relaxation) {
  Parameters p = drum(Along::y, 12);
  p.sph.density_relaxation = relaxation;
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.time < 1) model.advance(team);
  double of_places = 0, of_densities = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vector3& x = s.position[i];
    if (std::hypot(x.x - 10 * spacing, x.z - 10 * spacing) > 6.5 * spacing) continue;
    of_places += s.packing[i] * p.grains.density, of_densities += s.density[i];
  }
  return of_places / of_densities - 1;
}

TEST(VesselMotion, TheDensityOfABedThatIsShearedForLongStaysThatOfItsPlaces) {
  EXPECT_LT(std::abs(drift_in_drum(Parameters{}.sph.density_relaxation)), 0.02);
  EXPECT_GT(drift_in_drum(0), 0.06) << "the walls' sums are not the rate of anything";
}

TEST(VesselMotion, TheBitsDependNeitherOnThreadsNorOnResuming) {
  const Parameters p = drum(Along::y, 6);
  ThreadTeam one(1), two(2);
  Continuum model = started(p, one), other = started(p, two);
  while (model.state().time < 0.01) model.advance(one), other.advance(two);
  EXPECT_EQ(model.state().position, other.state().position);
  Continuum resumed(p);
  resumed.mutable_state() = model.state();
  resumed.resume(two);
  while (model.state().time < 0.02) model.advance(one), resumed.advance(two);
  EXPECT_EQ(model.state().position, resumed.state().position);
  EXPECT_EQ(model.state().patch_impulse, resumed.state().patch_impulse);
}

TEST(VesselMotion, ABeltStaysInItsPlane) {
  Parameters p = layer_on_a_floor();
  p.vessel[0].belt = {0.3, 0, 0.01};
  const auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "vessel.1.belt");
}

}  // namespace
}  // namespace talus::continuum
