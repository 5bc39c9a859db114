// SPDX-License-Identifier: Apache-2.0
/// What lies behind a nearer wall does not act: sheets drawn as closed solids, shells beside each other, partitions.
#include "models/continuum/boundary/wall_visibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "models/continuum/cases.hpp"
#include "models/continuum/drawn_parts.hpp"
#include "models/continuum/setup/vessel.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

/// A liquid, periodic along y, that settles on a floor between what a test adds.
Parameters liquid(double x, double z) {
  Parameters p = room(x, 5, z);
  p.box.front = p.box.rear = FaceKind::periodic;
  p.law = granular::LinearElastic::Parameters{.lambda = 2e5, .shear_modulus = 1e2};
  p.sph.viscosity_alpha = 0.3;
  p.sph.smoothing = Smoothing::local;
  p.gate.opens = GateOpens::when_settled;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.8;
  p.settle = {.speed = 5e-3, .duration = 0.02, .max_time = 3, .loading_time = {}, .damping_time = 5e-3};
  return p;
}

/// Mean pressures of layers of particles at rest, from below, Pa; those nearer than two spacings to the ends of the
/// layer left out.
std::vector<double> pressures_of_layers(const Parameters& p, double left, double right, double bottom, int layers) {
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.gate_time < 0) model.advance(team);
  std::vector<double> sum(static_cast<std::size_t>(layers), 0.0), count(sum);
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vector3& x = s.position[i];
    const double layer = (x.z - bottom) / spacing;
    if (x.x < left + 2 * spacing || x.x > right - 2 * spacing || layer < 0 || layer >= layers) continue;
    const auto n = static_cast<std::size_t>(layer);
    sum[n] += (s.material.stress[0][i] + s.material.stress[1][i] + s.material.stress[2][i]) / 3, ++count[n];
  }
  for (std::size_t n = 0; n < sum.size(); ++n) sum[n] /= count[n];
  return sum;
}

VesselPart upright(std::string name, double x, double from, double to) {
  return plate(std::move(name), {x, -10, from}, {0, 25, 0}, {0, 0, to - from});
}

constexpr int depth = 6;

/// A trough of two walls and a floor, 12 spacings wide, filled 6 deep.
Parameters trough() {
  Parameters p = liquid(26, 16);
  p.vessel = {plate("floor", {7, -10, 3}, {12, 0, 0}, {0, 25, 0}), upright("left", 7, 3, 14),
              upright("right", 19, 3, 14)};
  p.bed.left = 7 * spacing, p.bed.right = 19 * spacing;
  p.bed.bottom = 3 * spacing, p.bed.height = depth * spacing;
  return p;
}

std::vector<double> pressures_of_trough(const Parameters& p) {
  return pressures_of_layers(p, 7 * spacing, 19 * spacing, 3 * spacing, depth - 1);
}

TEST(WallVisibility, ASheetPressesAsOneWallOfItDoesWhateverItsThickness) {
  const std::vector<double> expected = pressures_of_trough(trough());
  const double hydrostatic = bulk_density(trough()) * 9.81 * spacing;
  EXPECT_NEAR(expected[0], (depth - 0.5) * hydrostatic, 0.05 * depth * hydrostatic);
  for (const double thickness : {0.02, 0.1, 0.5, 1.0, 2.0}) {
    Parameters p = trough();
    p.vessel.push_back(plate("under", {7 - thickness, -10, 3 - thickness}, {12 + 2 * thickness, 0, 0}, {0, 25, 0}));
    p.vessel.push_back(upright("outer left", 7 - thickness, 3 - thickness, 14));
    p.vessel.push_back(upright("outer right", 19 + thickness, 3 - thickness, 14));
    const std::vector<double> found = pressures_of_trough(p);
    for (std::size_t n = 0; n < expected.size(); ++n)
      EXPECT_NEAR(found[n], expected[n], 0.02 * expected[0]) << "sheet of " << thickness << ", layer " << n;
  }
}

TEST(WallVisibility, ASheetInOnePieceWithRoundRimsPressesAsOneWall) {
  // The faces of a floor of sheet belong to one smooth part: its edges are round.
  Parameters p = trough();
  const std::vector<double> expected = pressures_of_trough(p);
  constexpr double thickness = 0.2;
  std::vector<Triangle> triangles;
  std::vector<Vector3> outline{{8 * spacing, 0, 3 * spacing}, {18 * spacing, 0, 3 * spacing}};
  const auto half_circle = [&](double x, double from) {
    for (int n = 1; n < 9; ++n) {
      const double angle = from - n * std::numbers::pi / 9;
      outline.push_back({(x + 0.5 * thickness * std::cos(angle)) * spacing, 0,
                         (3 - 0.5 * thickness + 0.5 * thickness * std::sin(angle)) * spacing});
    }
  };
  half_circle(18, 0.5 * std::numbers::pi);
  outline.push_back({18 * spacing, 0, (3 - thickness) * spacing});
  outline.push_back({8 * spacing, 0, (3 - thickness) * spacing});
  half_circle(8, 1.5 * std::numbers::pi);
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const Vector3 a = outline[n] + Vector3{0, -10 * spacing, 0},
                  b = outline[(n + 1) % outline.size()] + Vector3{0, -10 * spacing, 0}, y{0, 25 * spacing, 0};
    triangles.push_back({{a, b, b + y}, 0});
    triangles.push_back({{a, b + y, a + y}, 0});
  }
  p.vessel[0] = drawn("floor", triangles);
  p.vessel[1] = upright("left", 8, 3, 14), p.vessel[2] = upright("right", 18, 3, 14);
  p.bed.left = 8 * spacing, p.bed.right = 18 * spacing;
  Parameters single = p;
  single.vessel[0] = plate("floor", {8, -10, 3}, {10, 0, 0}, {0, 25, 0});
  const auto pressures = [](const Parameters& of) {
    return pressures_of_layers(of, 8 * spacing, 18 * spacing, 3 * spacing, depth - 1);
  };
  const std::vector<double> found = pressures(p), reference = pressures(single);
  for (std::size_t n = 0; n < found.size(); ++n)
    EXPECT_NEAR(found[n], reference[n], 0.02 * reference[0]) << "layer " << n;
}

TEST(WallVisibility, APartitionOfSheetKeepsTheBedsOnBothSidesApart) {
  // Two upright faces a tenth of a spacing apart, filled on both sides, and the same without thickness.
  for (const double thickness : {0.02, 0.3}) {
    Parameters p = liquid(33, 16);
    p.vessel = {plate("floor", {4, -10, 3}, {26, 0, 0}, {0, 25, 0}), upright("left", 4, 3, 14),
                upright("right", 30, 3, 14)};
    p.bed.left = 4 * spacing, p.bed.right = 30 * spacing;
    p.bed.bottom = 3 * spacing, p.bed.height = depth * spacing;
    p.box.front = p.box.rear = FaceKind::periodic;
    Parameters one = p;
    one.vessel.push_back(upright("partition", 17, 2, 8));  // the beds are connected above it
    p.vessel.push_back(upright("face", 17, 2, 8));
    p.vessel.push_back(upright("other face", 17 + thickness, 2, 8));
    const auto pressures = [](const Parameters& of, double left, double right) {
      return pressures_of_layers(of, left * spacing, right * spacing, 3 * spacing, depth - 1);
    };
    for (const auto& [left, right] : {std::pair(4.0, 17.0), std::pair(17.0, 30.0)}) {
      const std::vector<double> found = pressures(p, left, right), expected = pressures(one, left, right);
      // Pressures of rows alternate, and the rows beside the thick sheet are not those of the lattice
      // (wall_fitting.hpp).
      double all = 0, expected_of_all = 0;
      for (std::size_t n = 0; n < found.size(); ++n) {
        EXPECT_NEAR(found[n], expected[n], 0.035 * expected[0]) << thickness << ", layer " << n;
        all += found[n], expected_of_all += expected[n];
      }
      EXPECT_NEAR(all, expected_of_all, 0.02 * expected_of_all) << thickness;
    }
  }
}

TEST(WallVisibility, WhatLiesBehindANearerWallBearsNothing) {
  Parameters p = trough();
  p.vessel.push_back(plate("under", {6.8, -10, 2.8}, {12.4, 0, 0}, {0, 25, 0}));
  // A wedge beneath: from the floor's left end down.
  p.vessel.push_back(plate("wedge", {7, -10, 2.95}, {12, 0, -1.5}, {0, 25, 0}));
  // One that crosses the floor and the left wall from outside.
  p.vessel.push_back(plate("crossing", {5, -10, 2.5}, {1.9, 0, 1.9}, {0, 25, 0}));
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.gate_time < 0) model.advance(team);
  const double floor = norm(vessel_impulse(s)[0]);
  EXPECT_GT(floor, 0);
  for (std::size_t hidden = 3; hidden < 6; ++hidden)
    EXPECT_LT(norm(vessel_impulse(s)[hidden]), 1e-3 * floor) << p.vessel[hidden].name;
}

TEST(WallVisibility, FollowsLinesOfSightOnlyWherePartsMayHideEachOther) {
  // A corner seen from within: each wall has the other on the side of the particle.
  const std::vector<Triangle> triangles{{{{{0, -5, 0}, {10, -5, 0}, {10, 5, 0}}}, 0},
                                        {{{{0, -5, 0}, {10, 5, 0}, {0, 5, 0}}}, 0},
                                        {{{{0, -5, 0}, {0, 5, 0}, {0, 5, 10}}}, 1},
                                        {{{{0, -5, 0}, {0, 5, 10}, {0, -5, 10}}}, 1},
                                        {{{{0, -5, -0.1}, {10, -5, -0.1}, {10, 5, -0.1}}}, 2},
                                        {{{{0, -5, -0.1}, {10, 5, -0.1}, {0, 5, -0.1}}}, 2}};
  const Surface surface(triangles, 3);
  const std::vector<Vector3> place{{1, 0, 0}, {0, 0, 1}, {1, -1, -0.1}};
  const std::vector<Vector3> normal{{0, 0, 1}, {1, 0, 0}, {0, 0, 1}};
  const std::vector<std::uint32_t> part{surface.part(0), surface.part(2), surface.part(4)};
  const WallVisibility visibility(surface, place, normal, part, 3, 1, 3);
  const auto seen = [&](const Vector3& x) {
    std::vector<std::uint32_t> numbers{0, 1, 2};
    std::vector<PointsOfPart> parts(3);
    for (std::size_t n = 0; n < 3; ++n) {
      parts[n].part = part[n];
      parts[n].points = std::span(numbers).subspan(n, 1);
      const double above = dot(normal[n], x - place[n]);
      parts[n].side = above > 0 ? Side::above : Side::below;
      parts[n].foot = x - above * normal[n], parts[n].above_nearest = above > 0;
      parts[n].normal = above > 0 ? normal[n] : -1.0 * normal[n];
    }
    std::vector<std::size_t> counts;
    for (std::size_t n = 0; n < 3; ++n) counts.push_back(visibility.keep_visible(x, parts, n));
    return counts;
  };
  EXPECT_THAT(seen({0.5, 0, 0.5}), testing::ElementsAre(1, 1, 0)) << "the sheet's other face is hidden";
  EXPECT_THAT(seen({0.5, -1, -0.5}), testing::ElementsAre(0, 0, 1)) << "and from below the upper one";
  EXPECT_THAT(seen({-0.5, 0, 0.5}), testing::ElementsAre(0, 1, 0)) << "from behind the upright wall";
}

}  // namespace
}  // namespace talus::continuum
