// SPDX-License-Identifier: Apache-2.0
/// The sums over the points of a wall that a particle takes.
#include "models/continuum/boundary/vessel_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "physics/sph/wall_integrals.hpp"

namespace talus::continuum {
namespace {

constexpr double spacing = 2e-3, h = spacing;

/// Particles over or under a plate, far from the origin.
struct AtAPlate {
  Vector3 corner{7.3, -4.1, 2.9};
  Surface plate;
  std::vector<Vector3> position;
  std::vector<double> smoothing_length, margin;

  AtAPlate() {
    const auto at = [&](double x, double y) { return corner + spacing * Vector3{x, y, 0}; };
    plate = Surface({{{at(0, 0), at(20, 0), at(20, 20)}, 0}, {{at(0, 0), at(20, 20), at(0, 20)}, 0}}, 1);
  }
  void add(double height, double x, double y, double may_move) {
    position.push_back(corner + spacing * Vector3{x, y, height});
    smoothing_length.push_back(h);
    margin.push_back(may_move * spacing);
  }
  VesselWalls met(InstructionSet set) {
    ThreadTeam team(1);
    const Vector3 room = spacing * Vector3{4, 4, 4};
    const Domain domain(Box{corner - room, corner + spacing * Vector3{20, 20, 0} + room, {}});
    Neighbourhood around(domain, plate);
    around.build(team, position, smoothing_length, margin);
    VesselWalls walls(plate, spacing, set);
    walls.find(team, around, position, smoothing_length, margin);
    walls.meet(team, position, smoothing_length);
    return walls;
  }
};

TEST(VesselWalls, SumsOverEverySetOfPointsAreThoseOfAPlane) {
  AtAPlate bed;
  Random random(3);
  std::vector<double> height;
  for (int n = 0; n < 400; ++n) {
    height.push_back(random.uniform(0.5, 1.9));
    bed.add(n % 2 == 0 ? height.back() : -height.back(), random.uniform(6, 14), random.uniform(6, 14), 0.05);
  }
  const double touching = sph::weight_of_plane(0.5);  // what errors are shares of
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!is_available(set)) continue;
    const VesselWalls walls = bed.met(set);
    for (std::size_t i = 0; i < height.size(); ++i) {
      const NearWalls met = walls.of(i);
      ASSERT_EQ(met.size(), 1u);
      const NearWall& wall = met.front();
      EXPECT_NEAR(wall.sums.weight * h, sph::weight_of_plane(height[i]), 0.009 * touching) << height[i];
      EXPECT_NEAR(wall.distance / spacing, height[i], 2e-6);
      EXPECT_NEAR(wall.normal.z, i % 2 == 0 ? 1 : -1, 1e-6);
      EXPECT_NEAR(wall.sums.slope[2], -wall.normal.z * norm(wall.slope()), 0.01 * touching / h);
    }
  }
}

/// The lists hold all points as long as a particle has moved and grown by its margin together: the sums go on smoothly
/// to where it then is.
TEST(VesselWalls, PointsSufficeForWhatAParticleMayMove) {
  for (const double margin : {0.05, 0.2}) {
    AtAPlate bed;
    for (int n = 0; n < 20; ++n) bed.add(0.6 + 0.1 * n, 8 + 0.13 * n, 9 + 0.07 * n, margin);
    const Vector3 room = spacing * Vector3{4, 4, 4};
    const Domain domain(Box{bed.corner - room, bed.corner + spacing * Vector3{20, 20, 0} + room, {}});
    ThreadTeam team(1);
    Neighbourhood around(domain, bed.plate);
    around.build(team, bed.position, bed.smoothing_length, bed.margin);
    VesselWalls walls(bed.plate, spacing, resolve(InstructionSet::automatic));
    walls.find(team, around, bed.position, bed.smoothing_length, bed.margin);
    std::vector<double> grown = bed.smoothing_length;
    for (std::size_t i = 0; i < grown.size(); ++i) {
      bed.position[i].z -= 0.6 * margin * spacing;
      grown[i] += 0.4 * margin * spacing;
    }
    ASSERT_TRUE(around.holds(team, bed.position, grown));
    walls.meet(team, bed.position, grown);
    for (std::size_t i = 0; i < grown.size(); ++i) {
      const double height = (bed.position[i].z - bed.corner.z) / grown[i];
      if (height > 1.99) continue;
      ASSERT_EQ(walls.of(i).size(), 1u) << height;
      EXPECT_NEAR(walls.of(i).front().sums.weight * grown[i], sph::weight_of_plane(height),
                  0.011 * sph::weight_of_plane(0.5))
          << height;
    }
  }
}

}  // namespace
}  // namespace talus::continuum
