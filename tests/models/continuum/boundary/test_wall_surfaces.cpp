// SPDX-License-Identifier: Apache-2.0
/// A wall acts alike whatever it is made of and however its triangles lie, up to its rim and across periodic faces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "models/continuum/inclines.hpp"

namespace talus::continuum {
namespace {

TEST(WallSurfaces, WhatFallsOnAWallStaysOnItWhateverTheWallIsMadeOf) {
  // A box and the triangles of a file rebound alike: not at all.
  constexpr double fall = 4 * spacing;
  for (const Incline& incline : inclines())
    for (const double along : {0.0, 0.31}) {  // on an edge of two triangles, and between
      const Vector3 at = incline.name == "face" ? Vector3{foot.x, foot.y, 0} : foot;
      ThreadTeam team(1);
      Continuum model(incline.make(0, at));
      const std::vector<PlacedParticle> one{{at + Vector3{along * spacing, 0, rest + fall}, {}}};
      place_particles(model, one, team);
      const State& s = model.state();
      const double impact = std::sqrt(2 * fall / gravity);
      while (s.time < 0.7 * impact) model.advance(team);
      EXPECT_NEAR(s.velocity[0].z, -gravity * s.time, 0.02 * gravity * impact) << incline.name << ", falls freely";
      double most = -gravity * impact;
      while (s.time < 3 * impact) {
        model.advance(team);
        most = std::max(most, s.velocity[0].z);
        if (s.time < 1.5 * impact) continue;
        ASSERT_NEAR(s.position[0].z - at.z, rest, 0.01 * spacing) << incline.name << " at " << s.time << " s";
        ASSERT_LT(norm(s.velocity[0]), 1e-6) << incline.name << " at " << s.time << " s";
      }
      EXPECT_LT(most, 1e-3 * gravity * impact) << incline.name << ", no rebound";
    }
}

/// A level rectangle with its corner at the origin's x and y, in so many squares of two triangles along each side.
std::vector<Triangle> level_rectangle(const Vector3& corner, double width, double depth, int along, int across) {
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int j) { return corner + Vector3{width * i / along, depth * j / across, 0}; };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, 0});
      triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}, 0});
    }
  return triangles;
}

TEST(WallSurfaces, TheTrianglesOfAPlaneAreOneWall) {
  // Along the edge that two triangles share, across edges, over corners: the same path.
  constexpr double speed = 0.6, friction = 0.5, distance = speed * speed / (2 * friction * gravity);
  for (const auto& [along, across] : {std::pair(1, 1), std::pair(60, 12), std::pair(7, 24), std::pair(240, 48)})
    for (const double y : {0.0, 0.25, 0.37}) {
      Parameters p = large_room();
      p.walls.coefficient = friction;
      p.vessel = {drawn(
          "plane", level_rectangle(foot - spacing * Vector3{15, 12, 0}, 60 * spacing, 24 * spacing, along, across))};
      ThreadTeam team(1);
      Continuum model(p);
      const Vector3 at = foot + Vector3{0, y * spacing, 0};
      place_particles(model, row_on(0, at, 1, speed), team);
      const State& s = model.state();
      while (s.time < 1.2 * speed / (friction * gravity)) {
        model.advance(team);
        ASSERT_NEAR(s.position[0].z - at.z, rest, 0.01 * spacing) << along << " x " << across;
      }
      EXPECT_NEAR(s.position[0].x - at.x, distance, 0.02 * distance) << along << " x " << across << " at y " << y;
      EXPECT_NEAR(s.position[0].y, at.y, 1e-3 * spacing) << along << " x " << across;
      EXPECT_LT(norm(s.velocity[0]), 1e-6);
    }
}

TEST(WallSurfaces, AWallEndsAtItsRim) {
  // What flies past where the plane of the wall would go on meets nothing; close above the rim it is slowed a little.
  for (const Incline& incline : inclines()) {
    if (incline.name == "face") continue;
    Parameters p = incline.make(pi / 2, foot);  // upright, its rim 15 spacings above
    p.gravity.acceleration = 0;
    p.bed.left = 0, p.bed.right = 4 * spacing;
    for (const double above : {2.5, 1.05 * sph::contact_distance}) {
      ThreadTeam team(1);
      Continuum model(p);
      const Vector3 velocity{1, 0, 0}, start = foot + spacing * Vector3{-8, 0, 15 + above};
      const std::vector<PlacedParticle> one{{start, velocity}};
      place_particles(model, one, team);
      const State& s = model.state();
      while (s.position[0].x < foot.x + 8 * spacing && s.time < 0.5) model.advance(team);
      const double change = norm(s.velocity[0] - velocity);
      EXPECT_LT(change, above > 2 ? 1e-12 : 0.1) << incline.name << " at " << above;
      EXPECT_LE(norm(s.velocity[0]), 1 + 1e-12) << incline.name << " at " << above;
      EXPECT_NEAR(s.position[0].z, start.z, above > 2 ? 1e-12 : spacing) << incline.name << " at " << above;
    }
  }
}

TEST(WallSurfaces, AThinSheetIsWholeAcrossAPeriodicFace) {
  constexpr double speed = 1, friction = 0.1, distance = speed * speed / (2 * friction * gravity);
  Parameters p = rubbing_room(20, 12, 20);
  p.walls.coefficient = friction;
  p.box.left = p.box.right = p.box.front = p.box.rear = FaceKind::periodic;
  const Vector3 corner{-4 * spacing, -4 * spacing, 8 * spacing};
  p.vessel = {drawn("sheet", sheet(corner, {28 * spacing, 0, 0}, {0, 20 * spacing, 0}, 0.1 * spacing))};
  ThreadTeam team(1);
  Continuum model(p);
  const Vector3 at{10 * spacing, 0.2 * spacing, 8 * spacing};
  place_particles(model, row_on(0, at, 4, speed), team);  // two of them beyond the face y = 0
  const State& s = model.state();
  while (s.time < 1.1 * speed / (friction * gravity)) {
    model.advance(team);
    for (const Vector3& x : s.position) ASSERT_NEAR(x.z - at.z, rest, 0.01 * spacing) << "at " << s.time << " s";
  }
  const double end = std::fmod(at.x + distance, p.box.width);  // after two and a half turns
  for (const Vector3& x : s.position) EXPECT_NEAR(x.x, end, 0.02 * distance);
}

TEST(WallSurfaces, BelowTheAngleOfFrictionNothingCreeps) {
  constexpr double friction = 0.5;
  for (const Incline& incline : inclines()) {
    if (incline.name == "face") continue;
    for (const double share : {0.5, 0.95}) {
      const double angle = share * std::atan(friction);
      Parameters p = incline.make(angle, foot);
      p.walls.coefficient = friction;
      ThreadTeam team(1);
      Continuum model(p);
      place_particles(model, row_on(angle, foot, 4, 0), team);
      const State& s = model.state();
      while (s.time < 0.1) model.advance(team);
      const std::vector<Vector3> settled(s.position.begin(), s.position.end());
      while (s.time < 0.5) model.advance(team);
      for (std::size_t i = 0; i < settled.size(); ++i)
        EXPECT_LT(norm(s.position[i] - settled[i]), 1e-6 * spacing) << incline.name << " at " << share;
    }
  }
}

TEST(WallSurfaces, ATurningEndWallTakesParticlesAlong) {
  // A disc, as the end of a drum, level: a particle slides until it has the disc's speed, and turns with it.
  constexpr double friction = 0.5, radius = 20 * spacing, spin = 2.5;
  Parameters p = rubbing_room(60, 60, 20);
  p.walls.coefficient = friction;
  VesselPart end = disc("end", 25, 8);
  end.centre = {30 * spacing, 30 * spacing};
  end.spin = spin;
  p.vessel = {end};
  ThreadTeam team(1);
  Continuum model(p);
  const Vector3 centre{30 * spacing, 30 * spacing, 8 * spacing};
  const std::vector<PlacedParticle> one{{centre + Vector3{radius, 0, rest}, {}}};
  place_particles(model, one, team);
  const State& s = model.state();
  const double taken = spin * radius / (friction * gravity);
  while (s.time < 0.5 * taken) model.advance(team);
  EXPECT_NEAR(norm(s.velocity[0]), friction * gravity * s.time, 0.02 * spin * radius);
  while (s.time < 3 * taken) model.advance(team);
  const Vector3 arm = s.position[0] - centre;
  const double r = std::hypot(arm.x, arm.y);
  EXPECT_NEAR(norm(s.velocity[0] - spin * Vector3{-arm.y, arm.x, 0}), 0, 0.02 * spin * r);
  EXPECT_NEAR(arm.z, rest, 0.01 * spacing);
  EXPECT_LT(r, 25 * spacing);
}

}  // namespace
}  // namespace talus::continuum
