// SPDX-License-Identifier: Apache-2.0
/// Particles beside walls of triangles.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "physics/coupling/deposition.hpp"

namespace talus::coupling {
namespace {

constexpr double cell = 1.25e-3;

/// A plate at an angle across a box, from wall to wall; particles above it.
struct SlantedFloor {
  ThreadTeam team{1};
  Grid grid{.count = {16, 8, 24}, .low = {}, .spacing = {cell, cell, cell}};
  Domain domain{{.low = {},
                 .high = {16 * cell, 8 * cell, 24 * cell},
                 .faces = {FaceKind::wall, FaceKind::wall, FaceKind::symmetry, FaceKind::symmetry, FaceKind::wall,
                           FaceKind::wall}}};
  Surface plate{{{{Vector3{-1e-3, -1e-3, height(-1e-3)}, Vector3{21e-3, -1e-3, height(21e-3)},
                   Vector3{21e-3, 11e-3, height(21e-3)}},
                  0},
                 {{Vector3{-1e-3, -1e-3, height(-1e-3)}, Vector3{21e-3, 11e-3, height(21e-3)},
                   Vector3{-1e-3, 11e-3, height(-1e-3)}},
                  0}},
                1};
  Deposition deposition{grid, domain, plate};
  std::vector<Vector3> position, velocity;
  CellField fraction = grid.cell_field();
  FaceField flux = grid.face_field();

  static double height(double x) { return 4.3 * cell + 0.6 * x; }

  void deposit() {
    velocity.resize(position.size());
    const std::vector<double> smoothing_length(position.size(), 1.6 * cell);
    deposition.find_weights(team, position, smoothing_length);
    deposition.deposit(team, 1e-9, {}, velocity, fraction, flux);
  }
  double total() const {
    double sum = 0;
    for (int k = 0; k < grid.count[2]; ++k)
      for (int j = 0; j < grid.count[1]; ++j)
        for (int i = 0; i < grid.count[0]; ++i) sum += grid.volume() * fraction[grid.index(i, j, k)];
    return sum;
  }
};

TEST(DepositionBesideASurface, PutsEverythingOnTheParticlesSide) {
  SlantedFloor floor;
  Random random(3);
  for (int n = 0; n < 400; ++n) {
    const double x = random.uniform(0, 16 * cell);
    floor.position.push_back({x, random.uniform(0, 8 * cell), floor.height(x) + random.uniform(0.05, 6) * cell});
  }
  floor.deposit();
  EXPECT_NEAR(floor.total(), 400e-9, 1e-14);
  for (int k = 0; k < floor.grid.count[2]; ++k)
    for (int i = 0; i < floor.grid.count[0]; ++i) {
      const Vector3 centre = floor.grid.centre(i, 3, k);
      if (centre.z < floor.height(centre.x)) {
        EXPECT_EQ(floor.fraction[floor.grid.index(i, 3, k)], 0) << i << ' ' << k;
      }
    }
  // Both sides of the box's mirrors are seen: the weights of what is folded back are kept.
  floor.position = {{0.2 * cell, 0.3 * cell, floor.height(0.2 * cell) + 8 * cell}};
  floor.deposit();
  EXPECT_NEAR(floor.total(), 1e-9, 1e-16);
}

TEST(DepositionBesideASurface, FarFromItChangesNothing) {
  SlantedFloor floor;
  floor.position = {{8 * cell, 4 * cell, floor.height(8 * cell) + 6 * cell}};
  floor.deposit();
  const CellField beside = floor.fraction;
  Deposition alone(floor.grid, floor.domain);
  alone.find_weights(floor.team, floor.position, std::vector<double>{1.6 * cell});
  alone.deposit(floor.team, 1e-9, {}, floor.velocity, floor.fraction, floor.flux);
  EXPECT_EQ(beside, floor.fraction);
}

TEST(DepositionBesideASurface, WhatSeesNoCellsCentreHasAll) {
  SlantedFloor floor;
  // Between the plate and the centre of the cell below the left face's lowest corner.
  floor.position = {{0.01 * cell, 4 * cell, floor.height(0.01 * cell) + 1e-9}};
  floor.deposit();
  EXPECT_NEAR(floor.total(), 1e-9, 1e-16);
}

}  // namespace
}  // namespace talus::coupling
