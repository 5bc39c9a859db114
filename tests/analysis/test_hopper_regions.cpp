// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/particles.hpp"

namespace talus {
namespace {

using testing::ElementsAre;

constexpr double h = 2e-3;
const HopperShape shape{0.1, 6e-3, 0.25, HopperShape::Outlet{0.1, 0.03, 0.07}, h};

FreeSurface level(double height) {
  FreeSurface surface;
  for (int n = 0; n < 50; ++n) {
    surface.x.push_back((n + 0.5) * h);
    surface.z.push_back(height);
  }
  return surface;
}

TEST(DeepParticles, LieBelowTheSurfaceOfTheirVessel) {
  const std::vector<Vector3> points = {
      {0.01, 0, 0.01},  {0.01, 0, 0.0139}, {0.01, 0, 0.0141},  // bin: the surface is at 20 mm
      {0.05, 0, 0.08},                                         // in the air
      {0.01, 0, 0.101}, {0.05, 0, 0.104},  {0.05, 0, 0.107},   // hopper; two of them over the slit
      {0.01, 0, 0.149}};
  EXPECT_THAT(deep_particles(points, {level(0.02), level(0.15)}, shape),
              ElementsAre(true, true, false, false, true, false, true, false));
  HopperShape box = shape;
  box.outlet.reset();
  EXPECT_THAT(deep_particles(points, {level(0.12), {}}, box),
              ElementsAre(true, true, true, true, true, true, true, false));
}

TEST(MeanBetween, LeavesOutWhatIsAboveAndBelow) {
  std::vector<Vector3> points;
  std::vector<double> packing;
  for (int n = 0; n <= 100; ++n) {
    points.push_back({0.04 + 2e-4 * n, 0, 0.05});
    packing.push_back(0.3 + 1e-3 * n);
  }
  points.push_back({0.09, 0, 0.2});
  packing.push_back(0.6);
  EXPECT_NEAR(mean_between(points, packing, 0.04, 0.06), 0.35, 1e-12);
}

}  // namespace
}  // namespace talus
