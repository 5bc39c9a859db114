// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/initial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/continuum/cases.hpp"

namespace talus::continuum {
namespace {

std::vector<Vector3> places(const Parameters& p) {
  return initial_state(setup_of(p)).position;
}

Parameters disordered(double disorder, std::int64_t seed) {
  Parameters p = column(6, 5, 7);
  p.bed.disorder = disorder, p.seed = seed;
  return p;
}

TEST(Initial, WithoutDisorderTheParticlesStandOnTheLattice) {
  EXPECT_EQ(places(disordered(0, 1)), bed_positions(Layout(column(6, 5, 7))));
  EXPECT_EQ(places(disordered(0, 2)), places(disordered(0, 1)));
}

TEST(Initial, DisorderIsUniformWithinItsBoundAlongEachAxis) {
  const double most = 0.1 * spacing;
  const std::vector<Vector3> lattice = bed_positions(Layout(column(6, 5, 7))), moved = places(disordered(0.1, 1));
  ASSERT_EQ(moved.size(), lattice.size());
  for (int axis = 0; axis < 3; ++axis) {
    double largest = 0, square = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const double by = moved[i][axis] - lattice[i][axis];
      largest = std::max(largest, std::abs(by)), square += by * by / static_cast<double>(moved.size());
    }
    EXPECT_LE(largest, most);
    EXPECT_GT(largest, 0.9 * most);
    EXPECT_NEAR(square, most * most / 3, 0.2 * most * most / 3);
  }
}

TEST(Initial, SeedsAreOtherPlacesAndTheSameSeedTheSame) {
  EXPECT_EQ(places(disordered(1e-6, 1)), places(disordered(1e-6, 1)));
  EXPECT_NE(places(disordered(1e-6, 1)), places(disordered(1e-6, 2)));
}

}  // namespace
}  // namespace talus::continuum
