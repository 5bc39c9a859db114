// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_regions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/particles.hpp"

namespace talus {
namespace {

using testing::ElementsAre;

constexpr double h = 2e-3;
const HopperShape shape{0.1, 6e-3, 0.25, HopperShape::Plate{0.1, 0.03, 0.07}, h};

FreeSurface level(double height) {
  FreeSurface surface;
  for (int n = 0; n < 50; ++n) {
    surface.x.push_back((n + 0.5) * h);
    surface.z.push_back(height);
  }
  return surface;
}

TEST(HopperShape, ItsCellsAreThreeQuartersOfASpacingAndFillTheWidth) {
  HopperShape paper = shape;
  paper.spacing = 1.6666667e-3;
  EXPECT_EQ(paper.cell(), 1.25e-3);
  HopperShape bin;
  bin.width = 6.8, bin.spacing = 0.4;
  EXPECT_EQ(bin.cell(), 6.8 / 23);
  bin.width = 0.1;
  EXPECT_EQ(bin.cell(), 0.1) << "narrower than a cell";
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
  box.plate.reset();
  EXPECT_THAT(deep_particles(points, {level(0.12), {}}, box),
              ElementsAre(true, true, true, true, true, true, true, false));
}

TEST(OutsideOutlet, IsBesideTheSlitOrAboveThePlate) {
  const std::vector<Vector3> points = {{0.05, 0, 0.05}, {0.02, 0, 0.05}, {0.05, 0, 0.11}, {0.02, 0, 0.11}};
  EXPECT_THAT(outside_outlet(points, shape), ElementsAre(false, true, true, true));
  HopperShape box = shape;
  box.plate.reset();
  EXPECT_THAT(outside_outlet(points, box), ElementsAre(true, true, true, true));
}

TEST(OutsideImpact, IsFarFromTheBinsSurfaceBelowTheSlit) {
  const std::vector<Vector3> points = {{0.05, 0, 0.035}, {0.05, 0, 0.041}, {0.085, 0, 0.02}, {0.091, 0, 0.02}};
  EXPECT_THAT(outside_impact(points, level(0.02), shape, 0.02), ElementsAre(false, true, false, true));
  EXPECT_THAT(outside_impact(points, level(std::nan("")), shape, 0.02), ElementsAre(true, true, true, true))
      << "before there is a surface it strikes the floor";
}

TEST(Stream, WidthAndMean) {
  std::vector<Vector3> points;
  std::vector<double> packing;
  for (int n = 0; n <= 100; ++n) {
    points.push_back({0.04 + 2e-4 * n, 0, 0.05});
    packing.push_back(0.3 + 1e-3 * n);
  }
  points.push_back({0.09, 0, 0.2});
  packing.push_back(0.6);
  EXPECT_NEAR(stream_width(points, 0.04, 0.06), 0.018, 1e-12);
  EXPECT_NEAR(mean_between(points, packing, 0.04, 0.06), 0.35, 1e-12);
  EXPECT_TRUE(std::isnan(stream_width(points, 0.06, 0.1)));
}

TEST(Corners, DenserThanTheRestOfTheLayer) {
  Section packing;
  packing.width = packing.height = 1e-3;
  packing.columns = 100;
  packing.rows = 250;
  for (std::size_t row = 0; row < packing.rows; ++row)
    for (std::size_t column = 0; column < packing.columns; ++column) {
      const bool corner = row < 10 && (column < 10 || column >= 90);
      const bool outermost = row < 1 || column < 1 || column >= 99;
      packing.value.push_back(outermost ? 7 : corner ? 0.66 : 0.6);
    }
  FreeSurface surface;
  for (std::size_t column = 0; column < 100; ++column) {
    surface.x.push_back(packing.x(column));
    surface.z.push_back(0.05);
  }
  const double mean = (9 * 18 * 0.66 + 9 * 80 * 0.6) / (9 * 98);
  EXPECT_NEAR(corner_packing_ratio(packing, surface, shape.bin(), shape, 0.01), 0.66 / mean, 1e-12);
  EXPECT_NEAR(corner_packing_over_middle(packing, shape.bin(), shape, 0.01), 1.1, 1e-12);
}

}  // namespace
}  // namespace talus
