// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/critical_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "base/random.hpp"
#include "physics/granular/appendix_b.hpp"
#include "physics/granular/material_path.hpp"
#include "physics/granular/stress_of_point.hpp"

namespace talus::granular {
namespace {

using Parameters = CriticalState::Parameters;

double friction_of(const SymmetricTensor3<>& stress) {
  return shear_of(stress) / mean(stress);
}
double state_packing(const Parameters& p, const Point& point) {
  return p.reference_packing / (1 + point.history.expansion);
}

/// A point sheared at a constant pressure: before each step its packing is set to that which bears the pressure.
struct ShearedAtPressure {
  Parameters parameters;
  double pressure;
  CriticalState law{parameters, grain_density, diameter};
  Point point = {};

  void advance(double rate, double step, int steps) { advance(shear(rate), step, steps); }
  void advance(const Tensor3<>& gradient, double step, int steps) {
    for (int k = 0; k < steps; ++k)
      point = law.update(
          point, gradient,
          grain_density * state_packing(parameters, point) * std::exp(pressure / parameters.bulk_modulus), step);
  }
};

double inertial_number(double rate, double pressure) {
  return rate * diameter * std::sqrt(grain_density / pressure);
}
double friction_at(const Parameters& p, double inertial) {
  return p.static_friction + (p.dynamic_friction - p.static_friction) / (1 + p.inertial_number / inertial);
}

TEST(CriticalState, StatePackingFollowsTheLogisticCurveFromLooseAndFromDense) {
  for (const double start : {0.53, 0.56, 0.62})
    for (const double rate : {0.5, 20.0}) {
      const double pressure = 1000;
      ShearedAtPressure sheared{{.reference_packing = start, .ageing_strength = 0}, pressure};
      const Parameters& p = sheared.parameters;
      const double critical = p.critical_packing - p.packing_slope * inertial_number(rate, pressure);
      const double increment = 1e-5;
      // The first strain is elastic, up to the yield point.
      double slipped = -(friction_at(p, inertial_number(rate, pressure)) + p.dilatancy * (start - critical)) *
                       pressure / p.shear_modulus;
      for (int k = 0; k < 20; ++k) {
        sheared.advance(rate, increment / rate, 5000);
        slipped += 5000 * increment;
        const double logistic = critical / (1 + (critical / start - 1) * std::exp(-p.dilatancy * critical * slipped));
        EXPECT_NEAR(state_packing(p, sheared.point), logistic, 5e-6) << start << ' ' << rate << ' ' << slipped;
      }
    }
}

TEST(CriticalState, EndsAtTheSamePackingAndStressFromLooseAndFromDense) {
  for (const double rate : {0.05, 50.0})
    for (const double start : {0.52, 0.585, 0.63}) {
      const double pressure = 500, inertial = inertial_number(rate, pressure);
      ShearedAtPressure sheared{{.reference_packing = start, .ageing_strength = 0}, pressure};
      sheared.advance(rate, 1e-4 / rate, 50000);
      EXPECT_NEAR(state_packing(sheared.parameters, sheared.point), 0.585 - 0.25 * inertial, 1e-6);
      EXPECT_NEAR(friction_of(sheared.point.stress), friction_at(sheared.parameters, inertial), 1e-5);
      EXPECT_NEAR(mean(sheared.point.stress), pressure, 1e-6);
    }
}

TEST(CriticalState, AtConstantVolumeEndsAtThePressureOfThatPacking) {
  // phi = 0.59: p = K ln(0.59/0.585) whatever phi_s was; phi = 0.57: no pressure at all.
  const double rate = 1e-3;  // so slow that I is negligible
  for (const double start : {0.575, 0.589}) {
    const AnyLaw law = make_law(Parameters{.reference_packing = start}, grain_density, diameter);
    const auto points = follow_path(law, std::vector<PathStretch>{{5 / rate, shear(rate)}},
                                    {.density = 0.59 * grain_density, .max_increment = 2e-5, .points = 1});
    EXPECT_NEAR(mean(points[1].stress), 4.9e6 * std::log(0.59 / 0.585), 20);
  }
  const AnyLaw loose = make_law(Parameters{.reference_packing = 0.569}, grain_density, diameter);
  const auto points = follow_path(loose, std::vector<PathStretch>{{5 / rate, shear(rate)}},
                                  {.density = 0.57 * grain_density, .max_increment = 2e-5, .points = 1});
  EXPECT_NEAR(mean(points[1].stress), 0, 1e-9);
}

TEST(CriticalState, PassesAPeakThatIsItsDilatancy) {
  const double rate = 0.01, pressure = 1000;
  ShearedAtPressure dense{{.reference_packing = 0.6, .ageing_strength = 0}, pressure};
  double peak = 0;
  for (int k = 0; k < 20000; ++k) {
    dense.advance(rate, 1e-4 / rate, 1);
    peak = std::max(peak, friction_of(dense.point.stress));
  }
  const double critical = friction_at(dense.parameters, inertial_number(rate, pressure));
  EXPECT_NEAR(peak - critical, 4 * (0.600 - 0.585), 2e-4);
  EXPECT_NEAR(friction_of(dense.point.stress), critical, 0.06 * std::exp(-4 * 0.585 * 2) * 1.1);
}

TEST(CriticalState, TakesAPartOfItsDilatancyIntoItsFriction) {
  const double rate = 0.01, pressure = 1000;
  Parameters p{.reference_packing = 0.6, .dilatancy = 8, .dilatant_friction = 0.5, .ageing_strength = 0};
  const double critical = friction_at(p, inertial_number(rate, pressure));
  ShearedAtPressure dense{p, pressure};
  double peak = 0;
  for (int k = 0; k < 2000; ++k) {
    dense.advance(rate, 1e-4 / rate, 1);
    peak = std::max(peak, friction_of(dense.point.stress));
  }
  EXPECT_NEAR(peak - critical, 0.5 * 8 * (0.600 - 0.585), 3e-4);
  // It dilates as fast as with all of it: 1/phi_s decays with k phi_c of the strain beyond yield.
  const double slipped = 0.2 - peak * pressure / p.shear_modulus;
  EXPECT_NEAR(state_packing(p, dense.point), 0.585 / (1 + (0.585 / 0.6 - 1) * std::exp(-8 * 0.585 * slipped)), 3e-5);
  // Far beyond the critical packing the friction is what the growth of volume takes.
  p.reference_packing = 0.7, p.static_friction = p.dynamic_friction = 0.2;
  ShearedAtPressure tight{p, pressure};
  peak = 0;
  for (int k = 0; k < 100; ++k) {
    tight.advance(rate, 1e-5 / rate, 1);
    peak = std::max(peak, friction_of(tight.point.stress));
  }
  EXPECT_NEAR(peak, 8 * (0.700 - 0.585), 1e-2);
}

/// The largest ratio over a small, fast shear, beyond the friction of flow.
double strength(ShearedAtPressure grains, double pressure) {
  double most = 0;
  for (int k = 0; k < 400; ++k) {
    grains.advance(50, 1e-8, 100);
    most = std::max(most, friction_of(grains.point.stress));
  }
  return most - friction_at(grains.parameters, inertial_number(50, pressure));
}

TEST(CriticalState, IsStrongerAtRestAndLosesThatByFlowing) {
  const double pressure = 1000, rate = 5;
  Parameters p{.reference_packing = 0.585, .packing_slope = 0};
  ShearedAtPressure grains{p, pressure};
  EXPECT_NEAR(strength(grains, pressure), 0, 3e-3);  // new: nothing has healed yet
  grains.advance(0, 1e-5, 2000);                     // two ageing times
  EXPECT_NEAR(grains.point.history.contacts, 1 - std::exp(-2.0), 2e-3);
  grains.advance(0, 1e-5, 10000);
  EXPECT_NEAR(strength(grains, pressure), 0.08, 3e-3);
  // In steady flow 1/(1 + rate T/gamma_0) of it is left.
  grains.advance(rate, 1e-5, 30000);
  EXPECT_NEAR(grains.point.history.contacts, 1 / (1 + rate * 10e-3 / 0.05), 1e-3);
  grains.advance(500, 1e-6, 3000);
  EXPECT_NEAR(grains.point.history.contacts, 0.01, 1e-3);
}

TEST(CriticalState, StrengthAtRestAddsToThatOfThePackingOrCountsWhereItIsMore) {
  const double pressure = 1000;
  for (const auto& [packing, added, larger] :
       {std::tuple{0.575, 0.04, 0.04}, {0.585, 0.08, 0.08}, {0.595, 0.12, 0.08}, {0.61, 0.18, 0.10}})
    for (const bool adds : {true, false}) {
      ShearedAtPressure grains{{.reference_packing = packing, .packing_slope = 0, .ageing_adds = adds}, pressure};
      grains.advance(0, 1e-5, 10000);  // ten ageing times
      EXPECT_NEAR(strength(grains, pressure), adds ? added : larger, 3e-3) << packing;
    }
}

TEST(CriticalState, GrainsApartAreFreeAndTouchWhereTheyCame) {
  const AnyLaw law = make_law(Parameters{}, grain_density, diameter);
  // Expanded from 0.6 to 0.57: apart, whatever the shear; pressed again they touch at 0.57.
  const double out = std::log(0.6 / 0.57);
  const auto points = follow_path(
      law,
      std::vector<PathStretch>{
          {1, squeeze(1e-4)}, {1, shear(1e-4)}, {1, squeeze(-1e-4 - out)}, {1, shear(0.3)}, {1, squeeze(1e-4)}},
      {.density = 0.6 * grain_density, .points = 1});
  EXPECT_NEAR(mean(points[1].stress), 490, 0.1);
  EXPECT_GT(norm(deviator(points[2].stress)), 100);
  for (const int apart : {3, 4}) EXPECT_EQ(points[static_cast<std::size_t>(apart)].stress, SymmetricTensor3<>{});
  EXPECT_EQ(points[4].history[1], 0);  // no contacts left
  EXPECT_NEAR(mean(points[5].stress), 490, 0.1);
  // Never looser than the loosest packing.
  const auto far =
      follow_path(law, std::vector<PathStretch>{{1, squeeze(-0.5)}, {1, squeeze(0.41)}, {1, squeeze(1e-2)}},
                  {.density = 0.6 * grain_density, .max_increment = 1e-5, .points = 1});
  EXPECT_EQ(far[2].stress, SymmetricTensor3<>{});
  EXPECT_NEAR(mean(far[3].stress), 4.9e6 * (std::log(0.6 / 0.55) - 0.08), 1);
}

TEST(CriticalState, TurnsItsStressWithAStressedBlock) {
  const Tensor3<> spin{.xz = M_PI / 2, .zx = -M_PI / 2};
  const auto points =
      follow_path(make_law(Parameters{}, grain_density, diameter),
                  std::vector<PathStretch>{{1, squeeze(4e-4)}, {1, shear(1e-4)}, {1, spin}}, {.points = 1});
  const SymmetricTensor3<>&before = points[2].stress, &after = points[3].stress;
  EXPECT_GT(std::abs(before.zx), 100);
  expect_near(after, transformed(before, rotation_about_y(M_PI / 2)), 1e-3);
  EXPECT_NEAR(norm(deviator(after)) / norm(deviator(before)), 1, 1e-12);
  EXPECT_EQ(points[2].history[0], points[3].history[0]);
}

TEST(CriticalState, AnswersTheSameInAnyAxes) {
  const Tensor3<> odd{0.3, -0.8, 0.5, 0.2, -0.6, 0.9, 1.1, 0.4, -0.9};
  const std::vector<PathStretch> path = {{1, squash(3e-4)}, {1, 2e-3 * odd}, {1, -3e-4 * odd}, {1, squeeze(-1e-4)}};
  const Tensor3<> rotation = rotation_about_z(0.3) * rotation_about_y(1.1);
  std::vector<PathStretch> other = path;
  for (PathStretch& stretch : other) stretch.velocity_gradient = turned(stretch.velocity_gradient, rotation);
  const AnyLaw law = make_law(Parameters{}, grain_density, diameter);
  const auto points = follow_path(law, path, {.points = 5}), others = follow_path(law, other, {.points = 5});
  for (std::size_t k = 0; k < points.size(); ++k) {
    expect_near(others[k].stress, transformed(points[k].stress, rotation), 1e-6);
    EXPECT_NEAR(others[k].history[0], points[k].history[0], 1e-12);
  }
}

TEST(CriticalState, TurnsWorkIntoHeatAndNeverBack) {
  // Along random paths: the work on a point is at least what is stored in it, p^2/2K + |s|^2/4G; volumes change by less
  // than a thousandth, so that the law's energy is that of small strains.
  Random random(11);
  const Parameters loose{.reference_packing = 0.57}, dense{},
      half{.dilatancy = 8, .dilatant_friction = 0.5},  // and one whose friction is beta alone
      slippery{.static_friction = 0.1,
               .dynamic_friction = 0.1,
               .dilatancy = 10,
               .dilatant_friction = 0.2,
               .ageing_strength = 0};
  for (const auto& [p, amplitude] : {std::pair{loose, 4e-4}, {dense, 4e-4}, {half, 1e-4}, {slippery, 2e-5}}) {
    const double start = p.reference_packing;
    const AnyLaw law = make_law(p, grain_density, diameter);
    double min_heat = 0, max_stored = 0;
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<PathStretch> path = {{1, squeeze(2e-4)}};
      for (int k = 0; k < 12; ++k) {
        const Tensor3<> gradient = random_gradient(random, amplitude);
        path.push_back({1, (k % 3 == 0 ? 20.0 : 1.0) * gradient - squeeze(trace(gradient))});
      }
      const auto points =
          follow_path(law, path, {.density = start * grain_density, .max_increment = 2e-6, .points = 100});
      const double stored = stored_in(points.back().stress, p);
      min_heat = std::min(min_heat, work_of_path(path, points) - stored);
      max_stored = std::max(max_stored, stored);
    }
    EXPECT_GT(max_stored, 0.01);
    EXPECT_GT(min_heat, -1e-3 * max_stored);
  }
}

TEST(CriticalState, IsElasticAndPerfectlyPlasticWithoutItsState) {
  // The special case that `drucker-prager` is with a constant friction.
  const Parameters plain{
      .static_friction = 0.5, .dynamic_friction = 0.5, .packing_slope = 0, .dilatancy = 0, .ageing_strength = 0};
  const DruckerPrager::Parameters same{.friction = 0.5, .fits = {.tables = Tables::printed}};
  const std::vector<PathStretch> path = {{1, squeeze(3e-4)}, {1, shear(1e-3)}, {1, shear(-3e-4)}, {1, squash(1e-4)}};
  const auto points = follow_path(make_law(plain, grain_density), path, {.points = 1}),
             expected = follow_path(make_law(same, grain_density), path, {.points = 1});
  for (std::size_t k = 0; k < points.size(); ++k) expect_near(points[k].stress, expected[k].stress, 1e-6);
}

TEST(CriticalState, SpeedOfSoundIsElastic) {
  EXPECT_NEAR(CriticalState({}).sound_speed(1500), std::sqrt((4.9e6 + 4.0 / 3 * 2.94e6) / 1500), 1e-9);
}

TEST(CriticalState, NamesContradictions) {
  EXPECT_TRUE(CriticalState::check({}).empty());
  ASSERT_EQ(CriticalState::check({.static_friction = 0.5, .dynamic_friction = 0.4}).size(), 1u);
  EXPECT_EQ(CriticalState::check({.static_friction = 0.5, .dynamic_friction = 0.4})[0].key, "dynamic_friction");
  EXPECT_EQ(CriticalState::check({.reference_packing = 0.45})[0].key, "reference_packing");
  EXPECT_EQ(CriticalState::check({.packing_slope = 1.7})[0].key, "packing_slope");
}

}  // namespace
}  // namespace talus::granular
