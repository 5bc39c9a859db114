// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/yuu_umekage_isotropic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/granular/appendix_b.hpp"
#include "physics/granular/material_path.hpp"

namespace talus::granular {
namespace {

constexpr double alpha = 9.8, reference_density = 1500;

PathPoint end_of(const AnyLaw& law, const std::vector<PathStretch>& path, const PathOptions& options = {}) {
  return follow_path(law, path, options).back();
}
double mean(const SymmetricTensor3<>& stress) {
  return trace(stress) / 3;
}

/// The law's formula, from the tables alone. \param volume e_v, where P rises; \param e deviator
SymmetricTensor3<> formula(const FittedFunctions& functions, double volume, const SymmetricTensor3<>& e) {
  const double a = std::sqrt(3.0) * volume, f = std::exp(3 * volume);
  const double p = alpha * f * (value(functions.a1, a) + 2 * value(functions.a2, a)) * volume;
  return isotropic(p) + p * value(functions.a4, norm(e)) * e;
}

TEST(YuuUmekageIsotropic, IsItsFormulaOnTheLoadingCurve) {
  for (const Tables tables : {Tables::repaired, Tables::printed}) {
    const AnyLaw law =
        make_law(YuuUmekageIsotropic::Parameters{.fits = {.tables = tables}, .unloading = Unloading::none}, 2500);
    const FittedFunctions& functions = tables == Tables::printed ? printed_2011 : repaired_2011;
    for (const double squashed : {2e-5, 1e-4, 1.9e-4, 1e-3}) {
      const PathPoint point = end_of(law, {{1, squash(squashed)}, {1, shear(0.4 * squashed)}});
      expect_near(point.stress, formula(functions, squashed / 3, deviator(point.strain)), 1e-4 * mean(point.stress));
      EXPECT_GT(point.stress.zz, point.stress.xx);
      EXPECT_LT(point.stress.zx, 0);  // du_x/dz > 0 is a negative e_zx, stress follows the strain's sign
    }
  }
}

TEST(YuuUmekageIsotropic, StressRatioOfABedWithHeldSides) {
  // Squashed until the weight is borne: 1226 Pa at the floor of the hopper's bed, 613 Pa in the middle. The physics
  // notes have 0.64 and 0.81, with A1 and A2 taken at the total |e|; at sqrt(3) e_v, as the law takes them, it is
  // these.
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.unloading = Unloading::none}, 2500);
  const std::vector<PathStretch> path = {{1, squash(4e-4)}};
  const auto points = follow_path(law, path, {.points = 2000});
  auto ratio_at = [&](double vertical) {
    for (const PathPoint& point : points)
      if (point.stress.zz >= vertical) return point.stress.xx / point.stress.zz;
    return 0.0;
  };
  EXPECT_NEAR(ratio_at(1226), 0.685, 0.002);
  EXPECT_NEAR(ratio_at(613), 0.878, 0.002);
}

TEST(YuuUmekageIsotropic, AnswersTheSameInAnyAxes) {
  const Tensor3<> odd{0.3, -0.8, 0.5, 0.2, -0.6, 0.9, 1.1, 0.4, -0.9};
  std::vector<PathStretch> path = {
      {1, squash(3e-4)}, {1, 2e-3 * odd}, {1, -3e-4 * odd}, {1, squeeze(-1e-4)}, {1, 1e-3 * transpose(odd)}};
  for (const YuuUmekageIsotropic::Parameters& parameters :
       {YuuUmekageIsotropic::Parameters{}, YuuUmekageIsotropic::Parameters{.unloading = Unloading::none},
        YuuUmekageIsotropic::Parameters{.fits = {.tables = Tables::printed},
        .contact = {.volume = Volume::strain},
        .unloading = Unloading::shear}}) {
    const AnyLaw law = make_law(parameters, 2500);
    const auto points = follow_path(law, path, {.points = 10});
    for (const Tensor3<>& rotation :
         {rotation_about_y(M_PI / 4), rotation_about_y(M_PI / 2), rotation_about_z(0.3) * rotation_about_y(1.1)}) {
      std::vector<PathStretch> other = path;
      for (PathStretch& stretch : other) stretch.velocity_gradient = turned(stretch.velocity_gradient, rotation);
      const auto others = follow_path(law, other, {.points = 10});
      for (std::size_t k = 0; k < points.size(); ++k)
        expect_near(others[k].stress, transformed(points[k].stress, rotation), 1e-6);
    }
  }
}

TEST(YuuUmekageIsotropic, TurnsItsStressWithAStressedBlock) {
  for (const Unloading unloading : {Unloading::none, Unloading::all}) {
    const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.unloading = unloading}, 2500);
    const Tensor3<> spin{.xz = M_PI / 2, .zx = -M_PI / 2};
    const std::vector<PathStretch> path = {{1, squash(2e-4)}, {1, shear(3e-4)}, {1, spin}};
    const auto points = follow_path(law, path, {.points = 1});
    const SymmetricTensor3<>&before = points[2].stress, &after = points[3].stress;
    EXPECT_GT(std::abs(before.zx), 100);
    expect_near(after, transformed(before, rotation_about_y(M_PI / 2)), 1e-3);
    EXPECT_NEAR(mean(after) / mean(before), 1, 1e-9);
    EXPECT_NEAR(norm(deviator(after)) / norm(deviator(before)), 1, 1e-6);
  }
}

TEST(YuuUmekageIsotropic, BearsNoTension) {
  for (const Volume volume : {Volume::contact, Volume::density, Volume::strain}) {
    const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.contact = {.volume = volume}}, 2500);
    EXPECT_EQ(end_of(law, {{1, squeeze(-1e-3)}, {1, shear(5e-3)}}).stress, SymmetricTensor3<>{});
    EXPECT_EQ(end_of(law, {{1, squash(2e-4)}, {1, shear(1e-3)}, {1, squash(-3e-4)}}).stress, SymmetricTensor3<>{});
  }
}

TEST(YuuUmekageIsotropic, PressureUnloadsAlongTheSteepLineAndReloadsToTheYieldPoint) {
  const double k_u = 1.5, first = 9e-4, back = 1e-4;
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.rule = {.unloading_stiffness = k_u}}, 2500);
  const auto points = follow_path(
      law, std::vector<PathStretch>{{1, squeeze(first)}, {1, squeeze(-back)}, {1, squeeze(back)}, {1, squeeze(back)}},
      {.points = 1});
  const double yield = mean(points[1].stress), low = mean(points[2].stress);
  const double line = k_u * alpha * (value(repaired_2011.a1, 0) + 2 * value(repaired_2011.a2, 0)) / 3;
  EXPECT_NEAR((yield - low) / back, line, 1e-3 * line);
  EXPECT_NEAR(mean(points[3].stress), yield, 1e-9 * yield);
  EXPECT_NEAR(mean(points[4].stress), mean(formula(repaired_2011, (first + back) / 3, {})), 1e-6 * yield);
}

TEST(YuuUmekageIsotropic, NoiseDoesNotThrowThePressureOffItsCurve) {
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{}, 2500);
  std::vector<PathStretch> noisy;
  for (int k = 0; k < 200; ++k) noisy.insert(noisy.end(), {{1, squeeze(9e-6)}, {1, squeeze(-6e-6)}});
  const double smooth = mean(end_of(law, {{1, squeeze(6e-4)}}).stress);
  // The last increment went back by 6e-6, some 44 Pa along the line.
  const double line = 1.5 * alpha * 1.4951e6 / 3 * 6e-6;
  const double last_peak = mean(end_of(law, {{1, squeeze(6.06e-4)}}).stress);
  EXPECT_NEAR(mean(end_of(law, noisy, {.points = 1}).stress), last_peak - line, 0.5);
  EXPECT_LT(mean(end_of(law, noisy, {.points = 1}).stress), smooth);
}

TEST(YuuUmekageIsotropic, ShearUnloadsReloadsAndGoesOn) {
  // As the paper's Figure 2: loading, D1 down, D2 up to the yield point F, and on as if nothing had been.
  const double k_u = 2.5;
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.rule = {.unloading_stiffness = k_u}}, 2500);
  const std::vector<PathStretch> path = {
      {1, squeeze(6e-4)}, {1, shear(4e-3)}, {1, shear(-2e-4)}, {1, shear(2e-4)}, {1, shear(4e-3)}};
  const auto points = follow_path(law, path, {.points = 1});
  const double p = mean(points[1].stress);
  const double yield = -points[2].stress.zx, low = -points[3].stress.zx;
  EXPECT_NEAR(yield / p, value(repaired_2011.a4, 2e-3 * std::sqrt(2.0)) * 2e-3, 2e-3);
  const double line = k_u * value(repaired_2011.a4, 0) * p;  // of tau_zx against e_zx
  EXPECT_NEAR((yield - low) / 1e-4, line, 2e-3 * line);
  EXPECT_GT(line, value(repaired_2011.a4, 0) * p);  // D2 steeper than A
  EXPECT_NEAR(-points[4].stress.zx, yield, 1e-3 * yield);
  const double uninterrupted = -end_of(law, {{1, squeeze(6e-4)}, {1, shear(8e-3)}}).stress.zx;
  EXPECT_NEAR(-points[5].stress.zx, uninterrupted, 1e-3 * uninterrupted);
}

TEST(YuuUmekageIsotropic, ShearFollowsTheFrictionOfA4AndStaysAtItsLargestDeviator) {
  for (const Unloading unloading : {Unloading::none, Unloading::all}) {
    const AnyLaw law =
        make_law(YuuUmekageIsotropic::Parameters{.fits = {.max_deviator = 0.01}, .unloading = unloading}, 2500);
    auto friction = [&](double sheared) {
      const auto points = follow_path(law, std::vector<PathStretch>{{1, squeeze(6e-4)}, {1, shear(sheared)}},
                                      {.max_increment = 1e-7, .points = 1});
      return -points[2].stress.zx / mean(points[2].stress);
    };
    for (const double deviator : {3e-4, 1e-3, 5e-3})
      EXPECT_NEAR(friction(std::sqrt(2.0) * deviator), value(repaired_2011.a4, deviator) * deviator / std::sqrt(2.0),
                  0.008)
          << deviator;
    const double limit = value(repaired_2011.a4, 0.01) * 0.01 / std::sqrt(2.0);
    EXPECT_NEAR(friction(0.02), limit, 2e-4);
    EXPECT_NEAR(std::atan(limit) * 180 / M_PI, 28.2, 0.05);
    EXPECT_NEAR(friction(0.05), limit, 2e-4);
  }
}

TEST(YuuUmekageIsotropic, ClosedCyclesOfPressureOrShearOnlyLoseEnergy) {
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{}, 2500);
  auto work = [&](const std::vector<PathStretch>& path, std::size_t skipped) {
    // The work from the end of the first `skipped` stretches on.
    const auto points = follow_path(law, path, {.max_increment = 1e-7, .points = 400});
    return work_of_path(path, points) -
           work_of_path(std::span(path).first(skipped), std::span(points).first(400 * skipped + 1));
  };
  for (const double size : {2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 2e-3}) {
    const double scale = size * 1000;  // J/m^3, strain times a pressure
    EXPECT_GT(work({{1, squeeze(size)}, {1, squeeze(-size)}, {1, squeeze(2 * size)}, {1, squeeze(-2 * size)}}, 0),
              -1e-6 * scale)
        << size;
    EXPECT_GT(work({{1, squeeze(6e-4)}, {1, shear(size)}, {1, shear(-2 * size)}, {1, shear(size)}}, 1), -1e-6 * scale)
        << size;
  }
}

TEST(YuuUmekageIsotropic, ShearAtLowAndBackAtHighPressureGainsAKnownEnergy) {
  // The shear stiffness goes with the pressure (Eq. 4), which no energy function allows: shear by de on the line at p1,
  // raise the pressure to p2, shear back, lower it. Gain: (p2 - p1) k_u A4(0) |de_dev|^2/2.
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{}, 2500);
  const double sheared = 1e-4;
  const std::vector<PathStretch> path = {// Harden, and come back to the middle of the elastic range.
                                         {1, squeeze(9e-4)},
                                         {1, squeeze(-1e-4)},
                                         {1, shear(2e-3)},
                                         {1, shear(-3e-4)},
                                         // The loop.
                                         {1, shear(sheared)},
                                         {1, squeeze(5e-5)},
                                         {1, shear(-sheared)},
                                         {1, squeeze(-5e-5)}};
  const auto points = follow_path(law, path, {.max_increment = 1e-8, .points = 200});
  const double low = mean(points[200 * 5].stress), high = mean(points[200 * 6].stress);
  expect_near(points.back().stress, points[200 * 4].stress, 0.02 * low);
  const double gain =
      -(work_of_path(path, points) - work_of_path(std::span(path).first(4), std::span(points).first(200 * 4 + 1)));
  const double line = 1.5 * value(repaired_2011.a4, 0);
  // Deviatoric stress at the loop's start adds its own share, (p2 - p1) n0 : de, of either sign.
  const double n0 = points[200 * 4].stress.zx / mean(points[200 * 4].stress);
  const double de = -sheared / 2;
  EXPECT_NEAR(gain, (high - low) * (line * de * de + 2 * n0 * de), 0.02 * std::abs(gain));
}

TEST(YuuUmekageIsotropic, ResetForgetsTheDeviatorWhileTheMainStrainFalls) {
  const auto parameters = YuuUmekageIsotropic::Parameters{.rule = {.reset = Reset::deviator, .smoothing_time = 0}};
  const AnyLaw law = make_law(parameters, 2500);
  // Vertically lengthened by 1e-3, sideways squeezed: the volume stays, the pressure with it.
  const Tensor3<> lengthen{.xx = -1e-3, .zz = 1e-3};
  const auto points =
      follow_path(law, std::vector<PathStretch>{{1, squash(6e-4)}, {1, shear(4e-3)}, {1, lengthen}, {1, shear(1e-4)}},
                  {.points = 1});
  EXPECT_GT(-points[2].stress.zx, 0.4 * mean(points[2].stress));
  EXPECT_NEAR(norm(deviator(points[3].stress)), 0, 0.02 * mean(points[3].stress));
  EXPECT_GT(mean(points[3].stress), 0.9 * mean(points[2].stress));
  // A new start on the loading curve: e_zx = 5e-5.
  const double e = 5e-5;
  EXPECT_NEAR(-points[4].stress.zx / mean(points[4].stress), value(repaired_2011.a4, std::sqrt(2.0) * e) * e, 0.01);
  // Without the rule the same path keeps the friction.
  const auto kept =
      follow_path(make_law(YuuUmekageIsotropic::Parameters{}, 2500),
                  std::vector<PathStretch>{{1, squash(6e-4)}, {1, shear(4e-3)}, {1, lengthen}}, {.points = 1});
  EXPECT_GT(norm(deviator(kept[3].stress)), 0.5 * mean(kept[3].stress));
}

TEST(YuuUmekageIsotropic, SmoothingKeepsShortFallsOfTheMainStrainFromResetting) {
  std::vector<PathStretch> path = {{1, squash(6e-4)}, {0.01, shear(0.4)}};
  // Squeezed for 3 us, let go for 2 us, at the same rate, 2000 times.
  for (int k = 0; k < 2000; ++k) path.insert(path.end(), {{3e-6, squeeze(0.3)}, {2e-6, squeeze(-0.3)}});
  auto friction = [&](double smoothing_time) {
    const AnyLaw law = make_law(
        YuuUmekageIsotropic::Parameters{.rule = {.reset = Reset::deviator, .smoothing_time = smoothing_time}}, 2500);
    const PathPoint point = end_of(law, path, {.points = 1});
    return norm(deviator(point.stress)) / mean(point.stress);
  };
  EXPECT_GT(friction(2e-4), 0.6);
  EXPECT_LT(friction(0), 1e-12);
}

TEST(YuuUmekageIsotropic, ContactGateTakesTheStressAwayBelowItsPacking) {
  // Loose grains squashed: the strain says pressure, the packing says no contact. 0.45/0.5 to the 96th power.
  const auto parameters =
      YuuUmekageIsotropic::Parameters{.contact = {.volume = Volume::strain}, .unloading = Unloading::none};
  const double dense = mean(end_of(make_law(parameters, 2500), {{1, squeeze(2e-4)}}).stress);
  const double loose = mean(end_of(make_law(parameters, 2500), {{1, squeeze(2e-4)}}, {.density = 0.45 * 2500}).stress);
  EXPECT_NEAR(loose / dense, 0.45 / 0.6 * std::pow(0.9, 96) * std::pow(1.0002, 96), 1e-7);
}

TEST(YuuUmekageIsotropic, BeyondClosePackingThePressureRisesAlongItsInitialStiffness) {
  const auto parameters = YuuUmekageIsotropic::Parameters{.unloading = Unloading::none};
  const YuuUmekageIsotropic law = std::get<YuuUmekageIsotropic>(make_law(parameters, 2500));
  auto pressure = [&](double packing) {
    return mean(law.update(MaterialPoint<YuuUmekageIsotropic>{}, Tensor3<>{}, 2500 * packing, 1e-6).stress);
  };
  EXPECT_LT(pressure(0.64) / pressure(0.62), 1.2) << "the fits level off";
  const double steep = alpha * (repaired_2011.a1.piece[0].c0 + 2 * repaired_2011.a2.piece[0].c0);
  const double volume = std::log(0.66 / 0.64) / 3;
  EXPECT_NEAR(pressure(0.66) - pressure(0.64) * 0.66 / 0.64, 0.66 / 0.6 * steep * volume, 0.02 * steep * volume);
  EXPECT_GT(pressure(0.66), 40e3) << "a stream at 1.5 m/s that is stopped at 77 m/s cannot go beyond";
}

TEST(YuuUmekageIsotropic, NoStateIsStifferThanTheSpeedOfSoundSays) {
  for (const Unloading unloading : {Unloading::none, Unloading::all}) {
    const auto parameters = YuuUmekageIsotropic::Parameters{.unloading = unloading};
    const AnyLaw law = make_law(parameters, 2500);
    const double c = std::visit([](const auto& one) { return one.sound_speed(reference_density); }, law);
    double steepest = 0;
    const std::vector<PathStretch> path = {
        {1, squash(1e-3)}, {1, squash(-1e-4)}, {1, squash(2e-3)}, {1, squash(-3e-3)}};
    const auto points = follow_path(law, path, {.points = 3000});
    for (std::size_t k = 1; k < points.size(); ++k)
      if (points[k].strain.zz != points[k - 1].strain.zz)
        steepest = std::max(steepest, (points[k].stress.zz - points[k - 1].stress.zz) /
                                          (points[k].strain.zz - points[k - 1].strain.zz));
    EXPECT_LT(steepest, c * c * reference_density * 1.01);
    EXPECT_GT(steepest, c * c * reference_density * (unloading == Unloading::none ? 0.97 : 0.6));
    EXPECT_NEAR(c, unloading == Unloading::none ? 97.3 : 119.2, 0.1);
  }
}

}  // namespace
}  // namespace talus::granular
