// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/yuu_umekage_printed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/granular/appendix_b.hpp"
#include "physics/granular/material_path.hpp"

namespace talus::granular {
namespace {

constexpr double alpha = 9.8;

/// The printed route: strain since the last reset, resets, no smoothing, nothing held.
YuuUmekagePrinted::Parameters printed_route() {
  return {.fits = {.tables = Tables::printed, .max_deviator = 1},
          .contact = {.volume = Volume::strain},
          .unloading = PrintedUnloading::all,
          .rule = {.reset = Reset::strain, .smoothing_time = 0}};
}
YuuUmekagePrinted loading_law(ShearSum sum = ShearSum::absolute) {
  return YuuUmekagePrinted({.fits = {.tables = Tables::printed, .max_deviator = 1},
                            .contact = {.volume = Volume::strain},
                            .shear_sum = sum,
                            .unloading = PrintedUnloading::none});
}
double mean(const SymmetricTensor3<>& stress) {
  return trace(stress) / 3;
}

TEST(YuuUmekagePrinted, IsEquations1To8) {
  const SymmetricTensor3<> e{1e-4, -2e-5, 3e-4, -5e-5, 8e-5, 2e-4};
  const double a = norm(e);
  const double A1 = value(printed_2011.a1, a), A2 = value(printed_2011.a2, a), A3 = value(printed_2011.a3, a),
               A4 = value(printed_2011.a4, a);
  const double xx = alpha * (A1 * 1e-4 + A2 * (-2e-5 + 3e-4) + A3 * (5e-5 + 2e-4));
  const double yy = alpha * (A1 * -2e-5 + A2 * (3e-4 + 1e-4) + A3 * (5e-5 + 8e-5));
  const double zz = alpha * (A1 * 3e-4 + A2 * (1e-4 - 2e-5) + A3 * (2e-4 + 8e-5));
  const double tau = (xx + yy + zz) / 3;
  expect_near(loading_law().loading_stress(e, alpha), {xx, yy, zz, -A4 * 5e-5 * tau, A4 * 8e-5 * tau, A4 * 2e-4 * tau},
              1e-10 * tau);
  // As printed, with the signs of the shear strains.
  const double xx_signed = alpha * (A1 * 1e-4 + A2 * (-2e-5 + 3e-4) + A3 * (-5e-5 + 2e-4));
  EXPECT_NEAR(loading_law(ShearSum::with_signs).loading_stress(e, alpha).xx, xx_signed, 1e-10 * tau);
}

TEST(YuuUmekagePrinted, UniaxialModuliAndStressRatioOfABed) {
  // M = alpha A1 = 8.8 MPa at zero strain, 11.8 MPa secant at most; the ratio A2/A1 is 0.30 to 0.37 at the strain of
  // the hopper's bed, 1.5e-4 to 3e-4.
  const YuuUmekagePrinted law = loading_law();
  EXPECT_NEAR(law.loading_stress({.zz = 1e-9}, alpha).zz / 1e-9, 8.82e6, 0.01e6);
  EXPECT_NEAR(law.loading_stress({.zz = 4.9999e-5}, alpha).zz / 4.9999e-5, 11.76e6, 0.01e6);
  for (double e = 1.5e-4; e <= 3e-4; e += 1e-5) {
    const SymmetricTensor3<> stress = law.loading_stress({.zz = e}, alpha);
    EXPECT_GE(stress.xx / stress.zz, 0.295) << e;
    EXPECT_LE(stress.xx / stress.zz, 0.375) << e;
  }
  EXPECT_NEAR(law.sound_speed(1500), 103, 1);
  EXPECT_NEAR(YuuUmekagePrinted({.fits = {.tables = Tables::printed}}).sound_speed(1500), 127, 1);  // k_u = 1.5
  EXPECT_NEAR(
      YuuUmekagePrinted({.fits = {.tables = Tables::printed}, .rule = {.unloading_stiffness = 3}}).sound_speed(1500),
      180, 1);
}

TEST(YuuUmekagePrinted, MirrorsKeepItUnlessShearSumsHaveSigns) {
  const SymmetricTensor3<> e{1e-4, 2e-5, 3e-4, 5e-5, -8e-5, 2e-4};
  const Tensor3<> mirror{.xx = -1, .yy = 1, .zz = 1};
  const auto difference = [&](const YuuUmekagePrinted& law) {
    return norm(law.loading_stress(transformed(e, mirror), alpha) - transformed(law.loading_stress(e, alpha), mirror));
  };
  EXPECT_NEAR(difference(loading_law()), 0, 1e-9);
  EXPECT_GT(difference(loading_law(ShearSum::with_signs)), 100);
}

TEST(YuuUmekagePrinted, DependsOnTheAxes) {
  // A uniaxial strain: turned by 90 degrees the same, turned by 45 degrees another shear stress, smaller or larger.
  const YuuUmekagePrinted law = loading_law();
  auto ratio = [&](double e, double angle) {
    const SymmetricTensor3<> strain{.zz = e};
    return norm(deviator(law.loading_stress(transformed(strain, rotation_about_y(angle)), alpha))) /
           norm(deviator(law.loading_stress(strain, alpha)));
  };
  for (const double e : {5e-5, 2e-4, 1e-3}) EXPECT_NEAR(ratio(e, M_PI / 2), 1, 1e-12);
  double least = 1, most = 1;
  for (double e = 1e-6; e < 0.03; e *= 1.01)
    least = std::min(least, ratio(e, M_PI / 4)), most = std::max(most, ratio(e, M_PI / 4));
  EXPECT_LT(least, 0.75);
  EXPECT_GT(most, 2);
}

TEST(YuuUmekagePrinted, BearsNoTension) {
  const YuuUmekagePrinted law = loading_law();
  EXPECT_EQ(law.loading_stress({.xx = 1e-4, .zz = -2e-4, .zx = 0}, alpha), SymmetricTensor3<>{});
  EXPECT_EQ(law.loading_stress({}, alpha), SymmetricTensor3<>{});
  // Eq. 8 as printed would have the size of this tension for a pressure.
  EXPECT_EQ(law.loading_stress({.xx = -1e-4, .yy = -1e-4, .zz = -1e-4, .zx = 1e-5}, alpha), SymmetricTensor3<>{});
}

TEST(YuuUmekagePrinted, UnloadsReloadsToTheYieldPointAndForgetsAtTheEnd) {
  YuuUmekagePrinted::Parameters parameters = printed_route();
  parameters.rule.unloading_stiffness = 3;
  const AnyLaw law = make_law(parameters, 2500);
  const std::vector<PathStretch> path = {{1, squash(2.5e-4)}, {1, squash(-1e-5)}, {1, squash(1e-5)},
                                         {1, squash(1e-5)},   {1, squash(-3e-4)}, {1, squash(1e-5)}};
  const auto points = follow_path(law, path, {.points = 1});
  const double yield = points[1].stress.zz, low = points[2].stress.zz;
  EXPECT_NEAR((yield - low) / 1e-5, 3 * alpha * value(printed_2011.a1, 0), 0.02 * 3 * alpha * 9e5);
  EXPECT_EQ(points[2].history[8], 1);  // unloading
  EXPECT_NEAR(points[3].stress.zz, yield, 1e-3 * yield);
  EXPECT_NEAR(points[4].stress.zz, alpha * value(printed_2011.a1, 2.6e-4) * 2.6e-4, 1e-3 * yield);
  EXPECT_EQ(points[4].history[8], 0);  // loading again
  EXPECT_EQ(points[4].history[9], 0);  // no reset so far
  EXPECT_EQ(points[5].stress, SymmetricTensor3<>{});
  EXPECT_GT(points[5].history[9], 0);
  EXPECT_EQ(points[5].history[2], 0);  // strain_zz
  // From zero strain again, although the grains are looser than at first by 4e-5.
  EXPECT_NEAR(points[6].stress.zz, alpha * value(printed_2011.a1, 1e-5) * 1e-5, 1e-3 * points[6].stress.zz);
}

TEST(YuuUmekagePrinted, UnloadedPastTheEndOfStressAtOnceItBearsNone) {
  // However far the step goes beyond the end of the line: most of all where it passes zero by a hair or by far.
  const Tensor3<> squash{.zz = -3e-4};
  for (YuuUmekagePrinted::Parameters options : {printed_route(), YuuUmekagePrinted::Parameters{}}) {
    options.rule.smoothing_time = 0;
    const YuuUmekagePrinted law = std::get<YuuUmekagePrinted>(make_law(options, 2500));
    const auto loaded = law.update({}, squash, 1500 * (1 + 3e-4), 1);
    EXPECT_GT(mean(loaded.stress), 100);
    for (const double back : {-0.8, -0.9, -1.0, -1.1, -2.0, -30.0}) {
      const auto point = law.update(loaded, back * squash, 1500.0, 1);
      EXPECT_GE(mean(point.stress), 0) << back;
      EXPECT_LE(mean(point.stress), mean(loaded.stress)) << back;
      if (back <= -1) {
        EXPECT_EQ(norm(point.stress), 0) << back;
      }
    }
  }
}

TEST(YuuUmekagePrinted, RatchetsUnlessTheVolumeIsTiedToTheDensity) {
  // Load to 1200 Pa, unload to nothing, again and again: with resets every cycle compacts the grains by the strain that
  // the unloading does not give back. With the volume tied to the density and no resets there is one compaction.
  auto compaction = [](const YuuUmekagePrinted::Parameters& parameters, int cycles) {
    const AnyLaw any = make_law(parameters, 2500);
    const auto& law = std::get<YuuUmekagePrinted>(any);
    MaterialPoint<YuuUmekagePrinted> point{};
    double squashed = 0;
    const double step = 1e-7;
    for (int cycle = 0; cycle < cycles; ++cycle)
      for (const double direction : {1.0, -1.0})
        while (direction > 0 ? point.stress.zz < 1200 : point.stress.zz > 0) {
          squashed += direction * step;
          point = law.update(point, squash(direction * step), 1500 * std::exp(squashed), 1.0);
        }
    return squashed;
  };
  const double one = compaction(printed_route(), 1), ten = compaction(printed_route(), 10);
  EXPECT_GT(one, 1e-5);
  EXPECT_NEAR(ten / one, 10, 0.2);
  YuuUmekagePrinted::Parameters tied = printed_route();
  tied.contact.volume = Volume::density;
  tied.rule.reset = Reset::never;
  EXPECT_NEAR(compaction(tied, 10), compaction(tied, 1), 0.05 * compaction(tied, 1));
}

TEST(YuuUmekagePrinted, TakesTheStrainOfDisplacementsAsItTakesTheRate) {
  YuuUmekagePrinted::Parameters parameters = printed_route();
  parameters.rule.reset = Reset::never;
  parameters.unloading = PrintedUnloading::none;
  const AnyLaw any = make_law(parameters, 2500);
  const auto& law = std::get<YuuUmekagePrinted>(any);
  MaterialPoint<YuuUmekagePrinted> by_rate{}, by_displacement{};
  const int steps = 1000;
  const double squashed = 1e-3, sheared = 2e-3;
  for (int n = 1; n <= steps; ++n) {
    // x = X + s Z, z = (1 - c) Z with both in proportion to time.
    const double t = static_cast<double>(n) / steps, middle = t - 0.5 / steps;
    const Tensor3<> displacement{.xz = sheared * t, .zz = -squashed * t};
    const double shrinking = 1 / (1 - squashed * middle);
    const Tensor3<> gradient{.xz = sheared * shrinking, .zz = -squashed * shrinking};
    const double density = 1500 / (1 - squashed * t);
    by_rate = law.update(by_rate, gradient, density, 1.0 / steps);
    by_displacement =
        law.update_at_strain(by_displacement, almansi_strain(displacement), gradient, density, 1.0 / steps);
  }
  EXPECT_GT(mean(by_rate.stress), 1000);
  expect_near(by_displacement.stress, by_rate.stress, 1e-5 * mean(by_rate.stress));
}

TEST(YuuUmekagePrinted, ForgetsDisplacementsAtAResetAsItForgetsTheStrain) {
  YuuUmekagePrinted::Parameters parameters = printed_route();
  const std::vector<PathStretch> path = {
      {1, Tensor3<>{.xz = 2e-4, .zz = -2.5e-4}}, {1, squash(-3e-4)}, {1, Tensor3<>{.xz = 1e-4, .zz = -1e-4}}};
  const auto by_rate = follow_path(make_law(parameters, 2500), path, {.points = 50});
  parameters.strain = Strain::displacements;
  const auto by_displacements = follow_path(make_law(parameters, 2500), path, {.points = 50});
  for (std::size_t k = 0; k < by_rate.size(); ++k)
    expect_near(by_displacements[k].stress, by_rate[k].stress, 1e-3 * mean(by_rate[50].stress));
  EXPECT_GT(by_displacements.back().history[9], 0);
  EXPECT_GT(mean(by_displacements.back().stress), 100);
}

TEST(YuuUmekagePrinted, ShearFallsWithTheMeanStressAndStaysWithinTheLargestFriction) {
  const AnyLaw law = make_law(printed_route(), 2500);
  const std::vector<PathStretch> path = {{1, squash(2.5e-4)},
                                         {1, Tensor3<>{.xz = 3e-4, .zz = -1e-5}},
                                         {1, squash(-4e-5)},
                                         {1, Tensor3<>{.xz = 2e-3, .zz = 1e-6}}};
  const auto points = follow_path(law, path, {.points = 50});
  const SymmetricTensor3<>&before = points[100].stress, &after = points[150].stress;
  EXPECT_LT(mean(after), 0.8 * mean(before));
  EXPECT_NEAR(after.zx / mean(after), before.zx / mean(before), 1e-4);
  const double limit = 0.0149999 * value(printed_2011.a4, 0.0149999);
  for (std::size_t k = 151; k < points.size(); ++k) {
    ASSERT_EQ(points[k].history[8], 1);
    EXPECT_LE(std::sqrt(2.0) * std::abs(points[k].stress.zx), limit * mean(points[k].stress) * (1 + 1e-9));
  }
  EXPECT_GT(std::sqrt(2.0) * std::abs(points.back().stress.zx), 0.99 * limit * mean(points.back().stress));
}

}  // namespace
}  // namespace talus::granular
