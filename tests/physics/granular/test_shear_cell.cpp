// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/shear_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "physics/granular/critical_state.hpp"

namespace talus::granular {
namespace {

const std::vector<double> fractions = {0.2, 0.5, 0.8};

CriticalState::Parameters powder(double friction) {
  return {.static_friction = friction,
          .dynamic_friction = friction,
          .packing_slope = 0,
          .ageing_strength = 0,
          .tensile_strength = 100,
          .consolidation_strength = 0.2,
          .cohesion_strain = 2};
}

TEST(ShearCell, FindsTheClosedFormsOfTheLaw) {
  for (const double m : {0.35, 0.5, 0.65})
    for (const double load : {1000.0, 6000.0}) {
      const AnyLaw law = make_law(powder(m), 2500);
      const ShearTest test = shear_test(law, load, fractions, {.density = 1500});
      const double a = 100 + 0.2 * load, c = m * a;
      EXPECT_NEAR(test.pre_shear.shear, m * (load + a), 0.003 * m * load);
      EXPECT_NEAR(test.density, 0.585 * 2500 * std::exp(load / 4.9e6), 0.1);
      // Sides held: K = (1 - 2G/3B)/(1 + 4G/3B) with G = 0.6 B, or what yield leaves, less than without dilatancy.
      const double at_yield = (load * (1 / std::sqrt(3.0) - 0.4 * m) - 100 * m) / (1 / std::sqrt(3.0) + 0.8 * m);
      EXPECT_NEAR(test.oedometer.axial, load, 1e-6 * load);
      EXPECT_GE(test.oedometer.lateral, 0.999 * load / 3);
      EXPECT_LE(test.oedometer.lateral, 1.01 * std::max(load / 3, at_yield));
      EXPECT_GT(test.density_in_oedometer, 1500);
      for (const YieldPoint& point : test.points) EXPECT_NEAR(point.shear, m * (point.normal + a), 0.01 * point.shear);
      EXPECT_NEAR(test.locus.cohesion, c, 0.01 * c);
      EXPECT_NEAR(std::tan(test.locus.angle), m, 0.01 * m);
      // f_c: 2 c cos/(1 - sin) with tan = M of the locus; of a compressed sample with sin = M; of a cylinder.
      const double slope = std::atan(m);
      EXPECT_NEAR(test.locus.strength, 2 * c * std::cos(slope) / (1 - std::sin(slope)), 0.01 * test.locus.strength);
      EXPECT_NEAR(test.strength_in_plane_strain, 2 * c / (1 - m), 0.01 * test.strength_in_plane_strain);
      EXPECT_NEAR(test.strength_of_cylinder, 3 * c / (std::sqrt(3.0) - m), 0.01 * test.strength_of_cylinder);
      // A triaxial sample: q = 3^(1/2) M (p + a), p = lateral + q/3.
      for (const Compression& sample : test.triaxial) {
        const double q = std::sqrt(3.0) * m * (sample.lateral + a) / (1 - m / std::sqrt(3.0));
        if (sample.lateral + q / 3 < load)
          EXPECT_NEAR(sample.axial, sample.lateral + q, 0.01 * sample.axial);
        else
          EXPECT_GT(sample.axial, sample.lateral + q);  // it is consolidated by the test
      }
    }
}

TEST(ShearCell, WithoutCohesionThereIsNoStrength) {
  CriticalState::Parameters sand = powder(0.5);
  sand.tensile_strength = sand.consolidation_strength = 0;
  const ShearTest test = shear_test(make_law(sand, 2500), 2000, fractions, {.density = 1500});
  EXPECT_NEAR(test.locus.cohesion, 0, 2);
  EXPECT_NEAR(test.strength_of_cylinder, 0, 2);
  EXPECT_NEAR(test.locus.effective_angle, std::atan(0.5), 0.01);
}

TEST(ShearCell, OnAWallSlidesAtItsLocusOrFailsItself) {
  const AnyLaw law = make_law(powder(0.5), 2500);
  const double load = 4000, a = 100 + 0.2 * load;
  const std::vector<double> normals = {800, 2000, 3200, load};
  const auto on = [&](std::optional<CellWall> wall) {
    return shear_test(law, load, fractions, {.density = 1500, .wall = wall}).on_wall;
  };
  EXPECT_TRUE(on(std::nullopt).empty());
  const std::vector<YieldPoint> smooth = on(CellWall{.coefficient = 0.3, .adhesion = 150}),
                                rough = on(CellWall{.coefficient = 0.9, .adhesion = 0}),
                                sticky = on(CellWall{.coefficient = 0.3, .adhesion = 500});
  ASSERT_EQ(smooth.size(), normals.size());
  for (std::size_t n = 0; n < normals.size(); ++n) {
    EXPECT_EQ(smooth[n].normal, normals[n]);
    EXPECT_DOUBLE_EQ(smooth[n].shear, 0.3 * normals[n] + 150);
    const double own = 0.5 * (normals[n] + a);
    EXPECT_NEAR(rough[n].shear, std::min(own, 0.9 * normals[n]), 0.01 * own);
    EXPECT_NEAR(sticky[n].shear, std::min(own, 0.3 * normals[n] + 500), 0.01 * own);
  }
  // Both walls are met on one side of their crossing and the grains on the other.
  EXPECT_LT(rough.front().shear, 0.95 * 0.5 * (800 + a));
  EXPECT_LT(rough.back().shear, 0.95 * 0.9 * load);
}

TEST(ShearCell, EvaluatesAsTheTradeDoes) {
  // A locus with c = 1 kPa and 30 degrees, and the circle about 8 kPa that touches it, at 5.27 kPa; pre-shear at 70
  // degrees from its centre, beyond where it touches.
  const double sine = 0.5, cosine = std::sqrt(0.75), apex = 1000 / std::tan(M_PI / 6);
  const double centre = 8000, radius = (centre + apex) * sine;
  const YieldPoint pre{centre - radius * std::cos(70 * M_PI / 180), radius * std::sin(70 * M_PI / 180)};
  std::vector<YieldPoint> points;
  for (const double normal : {1000.0, 2000.0, 3500.0}) points.push_back({normal, 1000 + normal * sine / cosine});
  const YieldLocus locus = evaluated(pre, points);
  EXPECT_NEAR(locus.cohesion, 1000, 1e-6);
  EXPECT_NEAR(locus.angle, M_PI / 6, 1e-9);
  EXPECT_NEAR(locus.strength, 2 * 1000 * cosine / (1 - sine), 1e-6);
  EXPECT_NEAR(locus.major, centre + radius, 1e-6);
  EXPECT_NEAR(std::sin(locus.effective_angle), radius / centre, 1e-9);
  EXPECT_NEAR(locus.flow_factor(), locus.major / locus.strength, 1e-12);
}

TEST(ShearCell, RefusesWhatIsNoLocus) {
  const YieldPoint pre{1000, 500};
  EXPECT_THROW(evaluated(pre, std::vector<YieldPoint>{{500, 300}}), std::invalid_argument);
  EXPECT_THROW(evaluated(pre, std::vector<YieldPoint>{{500, 300}, {800, 300}}), std::invalid_argument);
}

}  // namespace
}  // namespace talus::granular
