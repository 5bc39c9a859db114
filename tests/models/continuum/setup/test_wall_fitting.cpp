// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/wall_fitting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "models/continuum/bed_cases.hpp"
#include "models/continuum/cases.hpp"
#include "models/continuum/setup/initial.hpp"

namespace talus::continuum {
namespace {

constexpr double axis = 9.3 * spacing;

/// A silo of a cylinder on a cone, whose lattice leaves gaps beside its walls.
Parameters silo() {
  Parameters p = room(18.6, 18.6, 30);
  VesselPart cone = tube("cone", 9.3, 9.3, 0, 4, 12);
  cone.shape = VesselShape::cone;
  cone.lower_radius = 3 * spacing, cone.upper_radius = 8.7 * spacing;
  p.vessel = {tube("bin", 9.3, 9.3, 8.7, 12, 28), cone, gate_at(9.3, 9.3, 3, 4)};
  p.bed.height = 18 * spacing;
  return p;
}

/// In spacings: the mean and the largest gap of the particles nearest to the wall, one in each sector of 10 degrees of
/// each level.
std::vector<double> gaps(const Parameters& p, const std::vector<Vector3>& positions) {
  const Boundary boundary(p);
  std::map<std::pair<long, long>, double> nearest;
  for (const Vector3& x : positions) {
    const auto foot = boundary.vessel().nearest(x, 3 * spacing);
    if (!foot || x.z < 9 * spacing) continue;
    const double angle = std::atan2(x.y - axis, x.x - axis);
    const std::pair key{std::lround(x.z / spacing), std::lround(angle * 18 / std::numbers::pi)};
    const auto [at, is_new] = nearest.emplace(key, foot->distance / spacing);
    if (!is_new) at->second = std::min(at->second, foot->distance / spacing);
  }
  std::vector<double> found;
  for (const auto& [key, gap] : nearest) found.push_back(gap);
  return found;
}

TEST(WallFitting, TheFirstRowStandsHalfASpacingFromARoundWall) {
  const Parameters p = silo();
  const std::vector<double> lattice = gaps(p, bed_positions(Layout(p))),
                            fitted = gaps(p, initial_state(setup_of(p)).position);
  const auto far = [](const std::vector<double>& all) {
    const auto count = std::count_if(all.begin(), all.end(), [](double gap) { return gap > 0.6; });
    return static_cast<double>(count) / static_cast<double>(all.size());
  };
  EXPECT_GT(far(lattice), 0.25);
  EXPECT_LT(far(fitted), 0.05);
  EXPECT_GT(*std::min_element(fitted.begin(), fitted.end()), 0.4);
}

TEST(WallFitting, ParticlesKeepTheirLevelAndStandApart) {
  const Parameters p = silo();
  const std::vector<Vector3> lattice = bed_positions(Layout(p)), fitted = initial_state(setup_of(p)).position;
  ASSERT_EQ(fitted.size(), lattice.size());
  const Boundary boundary(p);
  double moved = 0, apart = 1e9;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    EXPECT_EQ(fitted[i].z, lattice[i].z);
    EXPECT_FALSE(boundary.vessel().blocks(lattice[i], fitted[i]));
    if (std::hypot(fitted[i].x - axis, fitted[i].y - axis) < 2 * spacing && fitted[i].z > 14 * spacing) {
      EXPECT_EQ(fitted[i], lattice[i]) << "far from walls the lattice stays";
    }
    moved = std::max(moved, norm(fitted[i] - lattice[i]));
    for (std::size_t j = 0; j < i; ++j) apart = std::min(apart, norm(fitted[i] - fitted[j]));
  }
  EXPECT_GT(moved, 0.2 * spacing);
  EXPECT_LE(moved, 0.75 * spacing);
  EXPECT_GT(apart, 0.7 * spacing);
}

TEST(WallFitting, ALatticeThatFitsStays) {
  Parameters p = room(10, 10, 14);
  p.vessel = {plate("left", {2, 0, 0}, {0, 10, 0}, {0, 0, 14})};
  p.bed.left = 2 * spacing, p.bed.height = 6 * spacing;
  const std::vector<Vector3> lattice = bed_positions(Layout(p)), fitted = initial_state(setup_of(p)).position;
  ASSERT_EQ(fitted.size(), lattice.size());
  for (std::size_t i = 0; i < fitted.size(); ++i) EXPECT_NEAR(norm(fitted[i] - lattice[i]), 0, 0.02 * spacing);
}

TEST(WallFitting, IsTheSameByAnyNumberOfThreads) {
  const auto setup = setup_of(silo());
  ThreadTeam team(3);
  EXPECT_EQ(initial_state(setup, team).position, initial_state(setup).position);
}

TEST(WallFitting, ParticlesOfAFileStay) {
  const Parameters p = silo();
  std::vector<Vector3> positions = bed_positions(Layout(p));
  const std::vector<Vector3> lattice = positions;
  ThreadTeam team;
  fit_to_walls(team, Boundary(p), spacing, lattice.size() / 2, positions);
  EXPECT_TRUE(std::equal(lattice.begin(), lattice.begin() + static_cast<std::ptrdiff_t>(lattice.size() / 2),
                         positions.begin()));
  EXPECT_NE(positions, lattice);
}

}  // namespace
}  // namespace talus::continuum
