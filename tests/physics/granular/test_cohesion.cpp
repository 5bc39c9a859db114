// SPDX-License-Identifier: Apache-2.0
/// Cohesion in the law critical-state (physics/granular/critical_state.hpp).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "physics/granular/appendix_b.hpp"
#include "physics/granular/critical_state.hpp"
#include "physics/granular/material_path.hpp"
#include "physics/granular/stress_of_point.hpp"

namespace talus::granular {
namespace {

using Parameters = CriticalState::Parameters;

/// Grains at their critical packing whose friction does not depend on the rate.
Parameters plain(double friction) {
  return {.static_friction = friction,
          .dynamic_friction = friction,
          .reference_packing = 0.585,
          .packing_slope = 0,
          .ageing_strength = 0};
}
Parameters sticky(double friction, double tensile_strength, double consolidation_strength, double consolidation = 0) {
  Parameters p = plain(friction);
  p.tensile_strength = tensile_strength;
  p.consolidation_strength = consolidation_strength;
  p.consolidation = consolidation;
  return p;
}

/// A point sheared at a constant pressure.
struct Sheared {
  Parameters parameters;
  CriticalState law{parameters, grain_density, diameter};
  Point point = {};

  double strength() const { return parameters.strength_at_start() + point.history.strengthening; }
  void advance(double pressure, double rate, double step, int steps) {
    for (int k = 0; k < steps; ++k) {
      const double touching = parameters.reference_packing / (1 + point.history.expansion);
      point =
          law.update(point, shear(rate), grain_density * touching * std::exp(pressure / parameters.bulk_modulus), step);
    }
  }
};

TEST(Cohesion, BearsTensionUpToItsStrengthAndThenNone) {
  const Parameters p = sticky(0.5, 1000, 0.1, 5000);
  ASSERT_DOUBLE_EQ(p.strength_at_start(), 1500);
  const CriticalState law(p, grain_density, diameter);
  const auto at = [&](const Point& point, double pressure) {
    const double touching = p.reference_packing / (1 + point.history.expansion);
    return law.update(point, {}, grain_density * touching * std::exp(pressure / p.bulk_modulus), 1e-4);
  };
  EXPECT_NEAR(mean(at({}, -700).stress), -700, 1e-6);
  EXPECT_NEAR(mean(at({}, -1499).stress), -1499, 1e-6);
  const Point apart = at({}, -1501);
  EXPECT_EQ(apart.stress, SymmetricTensor3<>{});
  EXPECT_EQ(apart.history.strengthening, -1500);
  EXPECT_EQ(apart.history.contacts, 0);
  // They touch again where they parted, and a load gives the strength that it stands for.
  EXPECT_EQ(at(apart, -1).stress, SymmetricTensor3<>{});
  const Point pressed = at(apart, 200);
  EXPECT_NEAR(mean(pressed.stress), 200, 1e-6);
  EXPECT_NEAR(pressed.history.strengthening, 1000 + 0.1 * 200 - 1500, 1e-6);
  EXPECT_NEAR(mean(at(pressed, -1019).stress), -1019, 1e-6);
  EXPECT_EQ(at(pressed, -1021).stress, SymmetricTensor3<>{});
}

TEST(Cohesion, MovesTheApexOfTheConeByTheStrength) {
  for (const double friction : {0.3, 0.5, 0.7})
    for (const double pressure : {-500.0, 0.0, 400.0, 3000.0}) {
      Parameters p = sticky(friction, 800, 0);
      p.cohesion_strain = 1e9;
      Sheared grains{p};
      grains.advance(pressure, 1e-3, 1e-2, 500);
      EXPECT_NEAR(shear_of(grains.point.stress), friction * (pressure + 800), 1e-6 * 800)
          << friction << ' ' << pressure;
      EXPECT_NEAR(mean(grains.point.stress), pressure, 1e-6);
    }
}

TEST(Cohesion, LoadsStrengthenAndShearForgetsThem) {
  Sheared grains{sticky(0.5, 50, 0.2)};
  EXPECT_EQ(grains.strength(), 50);
  grains.advance(4000, 0, 1e-4, 1);
  EXPECT_NEAR(grains.strength(), 50 + 0.2 * 4000, 1e-6);
  grains.advance(1000, 0, 1e-4, 1000);  // unloaded at rest: nothing is forgotten
  EXPECT_NEAR(grains.strength(), 850, 1e-6);
  // Beyond yield what exceeds 50 + 0.2 1000 decays within gamma_c.
  const double yield = 0.5 * (1000 + 850) / grains.parameters.shear_modulus, rate = 0.01, increment = 1e-5;
  grains.advance(1000, rate, increment / rate, 10000);
  EXPECT_NEAR(grains.strength(), 250 + 600 * std::exp(-(0.1 - yield) / 0.1), 1);
  EXPECT_NEAR(shear_of(grains.point.stress), 0.5 * (1000 + grains.strength()), 0.1);
  grains.advance(1000, rate, 1e-4 / rate, 20000);
  EXPECT_NEAR(grains.strength(), 250, 1e-3);
}

TEST(Cohesion, ShearUnderTensionBreaksAllBonds) {
  Sheared grains{sticky(0.5, 1000, 0)};
  grains.advance(-300, 0.01, 1e-3, 5000);  // a shear strain of 0.05, half of gamma_c
  EXPECT_NEAR(grains.strength(), 1000 * std::exp(-0.5), 5);
  grains.advance(-300, 0.01, 1e-3, 15000);
  EXPECT_EQ(grains.strength(), 0);
  EXPECT_EQ(grains.point.stress, SymmetricTensor3<>{});
}

TEST(Cohesion, PressesGrainsTogetherInTheInertialNumber) {
  Parameters p = sticky(0.4, 900, 0);
  p.dynamic_friction = 0.7, p.cohesion_strain = 1e9, p.dilatancy = 0;
  for (const double pressure : {-600.0, 0.0, 2000.0}) {
    Sheared grains{p};
    const double rate = 40;
    grains.advance(pressure, rate, 1e-5, 400);
    const double inertial = rate * diameter * std::sqrt(grain_density / (pressure + 900));
    EXPECT_NEAR(shear_of(grains.point.stress) / (pressure + 900), 0.4 + 0.3 / (1 + 0.279 / inertial), 1e-6);
  }
}

TEST(Cohesion, AnswersTheSameInAnyAxes) {
  const Tensor3<> odd{0.3, -0.8, 0.5, 0.2, -0.6, 0.9, 1.1, 0.4, 0.3};
  const std::vector<PathStretch> path = {{1, squash(3e-4)},   {1, squeeze(-3.5e-4)}, {1, 1e-4 * odd},
                                         {1, squeeze(-3e-3)}, {1, squeeze(3.2e-3)},  {1, -1e-3 * odd}};
  const Tensor3<> rotation = rotation_about_z(0.3) * rotation_about_y(1.1);
  std::vector<PathStretch> other = path;
  for (PathStretch& stretch : other) stretch.velocity_gradient = turned(stretch.velocity_gradient, rotation);
  const AnyLaw law = make_law(sticky(0.5, 300, 0.1, 1000), grain_density, diameter);
  const PathOptions options{.density = 0.585 * grain_density, .points = 5};
  const auto points = follow_path(law, path, options), others = follow_path(law, other, options);
  double most_tension = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    expect_near(others[k].stress, transformed(points[k].stress, rotation), 1e-6);
    EXPECT_NEAR(others[k].history[2], points[k].history[2], 1e-6);
    most_tension = std::max(most_tension, -mean(points[k].stress));
  }
  EXPECT_GT(most_tension, 100);
}

TEST(Cohesion, TurnsWorkIntoHeatAndNeverBack) {
  // As CriticalState.TurnsWorkIntoHeatAndNeverBack, with volumes that open under tension and cracks.
  Random random(7);
  const auto at = [](double packing, double dilatancy) {
    Parameters p = sticky(0.3, 400, 0.2, 500);
    p.reference_packing = packing, p.dilatancy = dilatancy;
    return p;
  };
  for (const Parameters& p : {at(0.57, 4), at(0.6, 4), at(0.575, 10)}) {
    const AnyLaw law = make_law(p, grain_density, diameter);
    double min_heat = 0, max_stored = 0;
    int cracked = 0, pulled = 0;
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<PathStretch> path = {{1, squeeze(1e-4)}};
      for (int k = 0; k < 12; ++k) {
        const Tensor3<> gradient = random_gradient(random, 2e-4);
        path.push_back({1, (k % 3 == 0 ? 5.0 : 1.0) * gradient - squeeze(0.8 * trace(gradient))});
      }
      const auto points = follow_path(
          law, path, {.density = p.reference_packing * grain_density, .max_increment = 2e-6, .points = 100});
      for (const PathPoint& point : points) {
        pulled += mean(point.stress) < -20;
        cracked += point.history[2] == -p.strength_at_start();
      }
      const double stored = stored_in(points.back().stress, p);
      min_heat = std::min(min_heat, work_of_path(path, points) - stored);
      max_stored = std::max(max_stored, stored);
    }
    EXPECT_GT(pulled, 100);
    EXPECT_GT(cracked, 100);
    EXPECT_GT(min_heat, -1e-3 * max_stored);
  }
}

TEST(Cohesion, WithoutItTheLawHasItsBits) {
  Parameters off = sticky(0.5, 0, 0, 1000);
  off.cohesion_strain = 3;
  const std::vector<PathStretch> path = {{1, squash(3e-4)}, {1, shear(2e-3)}, {1, squeeze(-1e-3)}, {1, squeeze(2e-3)}};
  const auto points = follow_path(make_law(off, grain_density, diameter), path),
             expected = follow_path(make_law(plain(0.5), grain_density, diameter), path);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_EQ(points[k].stress, expected[k].stress);
    EXPECT_EQ(points[k].history, expected[k].history);
  }
  EXPECT_FALSE(bears_tension(off));
  EXPECT_TRUE(bears_tension(sticky(0.5, 0, 0.1)));
  EXPECT_TRUE(bears_tension(sticky(0.5, 1, 0)));
}

TEST(Cohesion, NamesStrengthsBeyondTheStiffness) {
  EXPECT_TRUE(CriticalState::check(sticky(0.5, 1000, 0.1, 1000)).empty());
  ASSERT_EQ(CriticalState::check(sticky(0.5, 0.5e6, 0)).size(), 1u);
  EXPECT_EQ(CriticalState::check(sticky(0.5, 0.5e6, 0))[0].key, "tensile_strength");
  EXPECT_EQ(CriticalState::check(sticky(0.5, 0, 0.5, 2e6))[0].key, "consolidation");
}

}  // namespace
}  // namespace talus::granular
