// SPDX-License-Identifier: Apache-2.0
/// What holds few particles at a wall: contact and friction, the same for every kind of boundary.
#include "physics/sph/wall_contact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "models/continuum/cases.hpp"
#include "models/continuum/drawn_parts.hpp"
#include "models/continuum/few_particles.hpp"
#include "models/continuum/inclines.hpp"
#include "models/continuum/setup/vessel.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

TEST(WallContact, StopsWhatComesNearerAndTakesNoMoreThanTheApproach) {
  EXPECT_NEAR(sph::contact_push(-0.1, 0, 1e-3), 0.1, 1e-16);
  EXPECT_NEAR(sph::contact_push(-0.1, 2e-5, 1e-3), 0.08, 1e-16) << "as far as it may still go within the step";
  EXPECT_EQ(sph::contact_push(-0.1, 1, 1e-3), 0);
  EXPECT_EQ(sph::contact_push(0.1, 0, 1e-3), 0) << "what leaves is let go";
  EXPECT_NEAR(sph::contact_push(-0.1, -1e-3, 1e-3), 0.1, 1e-16) << "what is too near is not thrown out";
  const sph::WallContact wall{{0, 0, 1}, {}, 0, 0.5};
  const Vector3 held = sph::after_contact({1, 0, -0.1}, wall, 0.1);
  EXPECT_NEAR(held.z, 0, 1e-16);
  EXPECT_NEAR(held.x, 0.95, 1e-15);
  EXPECT_NEAR(sph::after_contact({1, 0, -0.1}, {{0, 0, 1}, {}, 0.3, 0.5}, 0.1).x, 0.8, 1e-15) << "with the stress";
  // A wall that moves along itself takes it along.
  EXPECT_NEAR(sph::after_contact({0, 0, -0.1}, {{0, 0, 1}, {0.02, 0, 0}, 0, 0.5}, 0.1).x, 0.02, 1e-16);
}

TEST(WallContact, FewParticlesStopAfterTheDistanceOfCoulomb) {
  constexpr double speed = 0.6, friction = 0.5, distance = speed * speed / (2 * friction * gravity);
  for (const Incline& incline : inclines())
    for (const Method method : {Method::leapfrog, Method::runge_kutta})
      for (const int count : {1, 4}) {
        const Vector3 at = incline.name == "face" ? Vector3{foot.x, foot.y, 0} : foot;
        Parameters p = incline.make(0, at);
        p.walls.coefficient = friction;
        p.integration.method = method;
        if (method == Method::runge_kutta) p.integration.courant = 0.3;
        ThreadTeam team(1);
        Continuum model(p);
        place_particles(model, row_on(0, at, count, speed), team);
        const State& s = model.state();
        const Vector3 begin = momentum_error(s);
        const std::string what = incline.name + (count > 1 ? ", a row" : ", one");
        while (s.time < 0.9 * speed / (friction * gravity)) model.advance(team);
        EXPECT_GT(s.velocity[0].x, 0) << what;
        while (s.time < 1.5 * speed / (friction * gravity)) model.advance(team);
        for (std::size_t i = 0; i < s.position.size(); ++i) {
          EXPECT_NEAR(s.position[i].x - at.x, distance, 0.02 * distance) << what;
          EXPECT_LT(norm(s.velocity[i]), 1e-6) << what;
          EXPECT_NEAR(s.position[i].z - at.z, rest, 0.01 * spacing) << what;
        }
        EXPECT_LT(norm(momentum_error(s) - begin), 1e-11 * norm(s.gravity_impulse)) << what;
      }
}

TEST(WallContact, AParticleSlidesDownAnInclineAsCoulombSays) {
  constexpr double angle = 35 * pi / 180;
  for (const Incline& incline : inclines()) {
    if (incline.name == "face") continue;
    for (const double friction : {0.0, 0.3, 0.8}) {
      Parameters p = incline.make(angle, foot);
      p.walls.coefficient = friction;
      ThreadTeam team(1);
      Continuum model(p);
      place_particles(model, row_on(angle, foot, 1, 0), team);
      const State& s = model.state();
      while (s.time < 0.1) model.advance(team);
      const double expected = std::max(0.0, gravity * (std::sin(angle) - friction * std::cos(angle)));
      EXPECT_NEAR(dot(s.velocity[0], down(angle)) / s.time, expected, 0.02 * gravity * std::sin(angle)) << incline.name;
      EXPECT_NEAR(dot(s.position[0] - foot, up(angle)), rest, 0.01 * spacing) << incline.name;
    }
  }
}

TEST(WallContact, AParticleSlidesAlongTheGeneratorOfAConeAsCoulombSays) {
  constexpr double angle = 50 * pi / 180, friction = 0.3;  // of the wall to the horizontal
  Parameters p = large_room();
  VesselPart cone = named("cone", VesselShape::cone);
  cone.centre = {60 * spacing, 6 * spacing};
  cone.bottom = 10 * spacing, cone.top = 60 * spacing;
  cone.lower_radius = 5 * spacing, cone.upper_radius = (5 + 50 / std::tan(angle)) * spacing;
  p.vessel = {cone};
  p.box.depth = 100 * spacing;
  p.walls.coefficient = friction;
  ThreadTeam team(1);
  Continuum model(p);
  for (const double azimuth : {0.1, 2.0}) {
    const Vector3 outward{std::cos(azimuth), std::sin(azimuth), 0};
    const Vector3 axis{60 * spacing, 6 * spacing, 0},
        generator = -std::cos(angle) * outward - Vector3{0, 0, std::sin(angle)};
    const Vector3 normal = -std::sin(angle) * outward + Vector3{0, 0, std::cos(angle)};
    const Vector3 start = axis + Vector3{0, 0, 50 * spacing} +
                          (5 * spacing + 40 * spacing / std::tan(angle)) * outward + 1.05 * rest * normal;
    const std::vector<PlacedParticle> one{{start, {}}};
    place_particles(model, one, team);
    const State& s = model.state();
    const double begin = s.time;
    while (s.time < begin + 0.12) model.advance(team);
    const double expected = gravity * (std::sin(angle) - friction * std::cos(angle));
    EXPECT_NEAR(dot(s.velocity[0], generator) / (s.time - begin), expected, 0.02 * expected);
  }
}

TEST(WallContact, LayersStopTogether) {
  // Of a wall that rubs less than the grains: they slide as a block.
  constexpr double speed = 1.2, friction = 0.25, distance = speed * speed / (2 * friction * gravity);
  for (const bool vessel : {false, true})
    for (const int layers : {1, 4}) {
      Parameters p = column(90, 4, layers, 6);
      make_granular(p);
      granular::CriticalState::Parameters sand;
      sand.bulk_modulus = 5e5, sand.shear_modulus = 3e5;
      sand.static_friction = 0.675, sand.dynamic_friction = 0.935;
      sand.reference_packing = p.bed.packing = 0.55, sand.critical_packing = 0.517, sand.random_loose_packing = 0.506;
      p.law = sand;
      p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::periodic;
      p.integration.method = Method::leapfrog;
      p.integration.courant = 0.6;
      p.walls.friction_from = FrictionFrom::start;
      p.walls.coefficient = friction;
      p.bed.left = 10 * spacing, p.bed.right = 45 * spacing;
      p.bed.velocity = {speed, 0, 0};
      if (vessel) {
        p.box.floor = FaceKind::open;
        p.vessel = {plate("floor", {-6, -6, 2}, {102, 0, 0}, {0, 16, 0})};
        p.box.height += 2 * spacing;
        p.bed.bottom = 2 * spacing;
      }
      ThreadTeam team(2);
      Continuum model = started(p, team);
      const State& s = model.state();
      const auto middle = [&] {
        double x = 0;
        for (const Vector3& at : s.position) x += at.x / double(s.position.size());
        return x;
      };
      const double begin = middle();
      while (s.time < 1.2 * speed / (friction * gravity)) model.advance(team);
      EXPECT_NEAR(middle() - begin, distance, 0.02 * distance) << layers << " layers" << (vessel ? ", vessel" : "");
      for (const Vector3& x : s.position)
        EXPECT_GT(x.z - (vessel ? 2 * spacing : 0), 0.45 * spacing)
            << layers << " layers" << (vessel ? ", vessel" : "");
    }
}

TEST(WallContact, ATurningDrumTakesAParticleAlongToTheAngleOfFriction) {
  constexpr double friction = 0.4, radius = 30 * spacing, surface_speed = 0.3;
  Parameters p = rubbing_room(80, 12, 80);
  p.walls.coefficient = friction;
  VesselPart shell = named("shell", VesselShape::cylinder);
  shell.along = Along::y, shell.centre = {40 * spacing, 40 * spacing};
  shell.radius = radius, shell.bottom = -14 * spacing, shell.top = 26 * spacing;
  shell.spin = surface_speed / radius;
  p.vessel = {shell};
  p.bed.height = 12 * spacing;
  ThreadTeam team(1);
  Continuum model(p);
  const Vector3 axis{40 * spacing, 6 * spacing, 40 * spacing};
  // The wall is a polygon: particles begin all over two of its sides, too far apart to meet.
  constexpr int count = 6;
  constexpr double two_sides = 0.146;
  std::vector<PlacedParticle> lowest;
  for (int n = 0; n < count; ++n) {
    const double angle = two_sides * ((n + 0.5) / count - 0.5);
    lowest.push_back({axis + Vector3{(radius - 1.02 * rest) * std::sin(angle), 4 * (n - 2.5) * spacing,
                                     -(radius - 1.02 * rest) * std::cos(angle)},
                      {}});
  }
  place_particles(model, lowest, team);
  const State& s = model.state();
  const double taken = surface_speed / (friction * gravity), path = radius - rest;
  // Of each particle, towards where the wall goes: lowest at -x.
  const auto angle_of = [&](std::size_t i) { return std::atan2(axis.x - s.position[i].x, axis.z - s.position[i].z); };
  while (s.time < 0.1 * taken) model.advance(team);
  std::array<double, count> speed{}, turned{};
  for (std::size_t i = 0; i < count; ++i) speed[i] = -s.velocity[i].x, turned[i] = angle_of(i);
  while (s.time < 0.8 * taken) {
    model.advance(team);
    for (std::size_t i = 0; i < count; ++i) {
      speed[i] +=
          (friction * (gravity * std::cos(turned[i]) + speed[i] * speed[i] / path) - gravity * std::sin(turned[i])) *
          s.last_step;
      turned[i] += speed[i] * s.last_step / path;
    }
  }
  double computed = 0, expected = 0;
  for (std::size_t i = 0; i < count; ++i) computed += norm(s.velocity[i]) / count, expected += speed[i] / count;
  EXPECT_NEAR(computed, expected, 0.02 * expected);
  double most = 0;
  while (s.time < 3 * taken) {
    model.advance(team);
    for (std::size_t i = 0; i < count; ++i) most = std::max(most, norm(s.velocity[i]));
  }
  EXPECT_NEAR(most, surface_speed, 0.02 * surface_speed) << "with the wall, not faster";
  // Carried up to where they slide, they swing a little about the angle of friction.
  double angle = 0, time = 0;
  while (s.time < 4) {
    model.advance(team);
    if (s.time < 2) continue;
    for (std::size_t i = 0; i < count; ++i) angle += angle_of(i) / count * s.last_step;
    time += s.last_step;
  }
  EXPECT_NEAR(angle / time, std::atan(friction), 0.02 * std::atan(friction));
}

/// Kinetic and potential energy over mass, m^2/s^2; with the leapfrog the velocity is of half a step before.
double energy(const State& s, std::size_t i) {
  return 0.5 * dot(s.velocity[i], s.velocity[i]) + gravity * s.position[i].z;
}

TEST(WallContact, ALoneParticleNeverGainsEnergyAtBendsAndRims) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
  };
  for (int trial = 0; trial < 24; ++trial) {
    // A strip of plates, one after the other, each at another angle: bends to either side, a rim at the end.
    Parameters p = large_room();
    p.sph.viscosity_alpha = between(0.01, 0.5);
    p.walls.coefficient = trial % 3 == 0 ? 0 : between(0, 0.6);
    const double size = between(0.6, 12) * spacing;
    std::vector<Triangle> triangles;
    Vector3 from{4 * spacing, -6 * spacing, 90 * spacing};
    for (int n = 0; n < 60 && from.z > 5 * spacing; ++n) {
      const double angle = between(-20, 75) * pi / 180;
      const Vector3 to = from + size * Vector3{std::cos(angle), 0, -std::sin(angle)}, across{0, 24 * spacing, 0};
      triangles.push_back({{from, to, to + across}, 0});
      triangles.push_back({{from, to + across, from + across}, 0});
      from = to;
    }
    p.vessel = {drawn("terrain", triangles)};
    ThreadTeam team(1);
    Continuum model(p);
    const std::vector<PlacedParticle> one{
        {{8 * spacing, between(4, 8) * spacing, 92 * spacing}, {between(0, 2), between(-0.5, 0.5), between(-1, 0)}}};
    place_particles(model, one, team);
    const State& s = model.state();
    const double start = energy(s, 0);
    // What velocities of half a step before and gravity of a whole step can differ by.
    double most = start;
    while (s.time < 0.8 && s.position[0].z > 0) {
      model.advance(team);
      const double slack = gravity * s.last_step * (norm(s.velocity[0]) + gravity * s.last_step);
      ASSERT_LE(energy(s, 0), most + slack) << "trial " << trial << " at " << s.time << " s";
      most = std::min(most, std::max(energy(s, 0), 0.0)) + 0.02 * gravity * spacing * s.last_step / 0.8;
    }
  }
}

}  // namespace
}  // namespace talus::continuum
