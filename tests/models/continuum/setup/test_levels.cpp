// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "models/continuum/level_cases.hpp"

namespace talus::continuum {
namespace {

TEST(Levels, TheLevelOfAMassIsTheNearest) {
  EXPECT_EQ(level_of(1), 0);
  EXPECT_EQ(level_of(2), 0);
  EXPECT_EQ(level_of(3), 1);
  EXPECT_EQ(level_of(8), 1);
  EXPECT_EQ(level_of(22), 1);
  EXPECT_EQ(level_of(23), 2);
  EXPECT_EQ(level_of(64), 2);
  EXPECT_EQ(level_of(512), 3);
}

TEST(Levels, HalvesQuartersAndEighthsAreBelow) {
  EXPECT_EQ(level_of(0.75), 0);
  EXPECT_EQ(level_of(0.625), -1);
  EXPECT_EQ(level_of(0.5), -1);
  EXPECT_EQ(level_of(0.375), -1);
  EXPECT_EQ(level_of(0.25), -2);
  EXPECT_EQ(level_of(0.125), -3);
}

TEST(Levels, EachBeginsAtTwiceTheDistanceOfTheOneBefore) {
  Parameters p = bed_of_levels(3);
  p.levels.distance = 2 * spacing;
  const Levels levels{Layout(p)};
  // From the box, whose upper end along x is at 8 spacings.
  const auto at = [&](double spacings) { return levels.wanted({spacings * spacing, 4 * spacing, 4 * spacing}); };
  EXPECT_EQ(at(4), 0);
  EXPECT_EQ(at(9.9), 0);
  EXPECT_EQ(at(10.1), 1);
  EXPECT_EQ(at(11.9), 1);
  EXPECT_EQ(at(12.1), 2);
  EXPECT_EQ(at(15.9), 2);
  EXPECT_EQ(at(16.1), 3);
  EXPECT_EQ(at(100), 3);
}

TEST(Levels, TheSmoothSpacingHasThatOfALevelWhereItBegins) {
  const Parameters p = bed_of_levels(2);
  const Levels levels{Layout(p)};
  const auto at = [&](double spacings) { return levels.smooth_spacing({(8 + spacings) * spacing, 0, 0}); };
  EXPECT_EQ(at(-1), 1);
  EXPECT_NEAR(at(1), 1.5, 1e-12);
  EXPECT_NEAR(at(2), 2, 1e-12);
  EXPECT_NEAR(at(3), 3, 1e-12);
  EXPECT_NEAR(at(4), 4, 1e-12);
  EXPECT_EQ(at(9), 4);
  EXPECT_EQ(Levels(Layout(bed_of_levels(0))).smooth_spacing({}), 1);
}

TEST(Levels, OfASlitReachAroundAllOfIt) {
  Parameters p = bed_of_levels(1);
  p.levels.low = p.levels.high = std::nullopt;
  p.levels.distance = 2 * spacing;
  p.plate = {.height = 4 * spacing, .slit_left = 10 * spacing, .slit_right = 14 * spacing};
  p.bed.bottom = 4 * spacing;
  const Levels levels{Layout(p)};
  for (const double y : {0.1, 4.0, 7.9}) {
    EXPECT_EQ(levels.wanted({15.9 * spacing, y * spacing, 4 * spacing}), 0);
    EXPECT_EQ(levels.wanted({16.1 * spacing, y * spacing, 4 * spacing}), 1);
    EXPECT_EQ(levels.wanted({12 * spacing, y * spacing, 6.1 * spacing}), 1);
  }
}

TEST(Levels, TheMiddleOfACellIsInIt) {
  Parameters in_sector = sector_of_levels();
  in_sector.levels.count = 2;
  for (const Parameters& p : {bed_of_levels(2), in_sector}) {
    const Layout layout(p);
    const Levels levels(layout);
    for (const Vector3& x : bed_positions(layout))
      for (const int level : {0, 1}) {
        const auto cell = levels.cell_of(x, level);
        const Vector3 middle = levels.middle_of(cell, level);
        ASSERT_EQ(levels.cell_of(middle, level), cell);
        EXPECT_LT(norm(middle - x), 2.0 * (1 << level) * spacing);
      }
  }
}

TEST(Levels, FewerParticlesAreForeseenAsTheyAreLaid) {
  const Parameters p = bed_of_levels(1);
  const auto setup = setup_of(p);
  const double laid = static_cast<double>(initial_state(setup).position.size());
  EXPECT_NEAR(share_of_particles(setup) * bed_count(setup), laid, 0.03 * laid);
  EXPECT_LT(laid, 0.6 * bed_count(setup));
}

TEST(Levels, FinerParticlesNearAnOutletStayTheLongestWhileABedEmpties) {
  Parameters p = bed_of_levels(0);
  const std::vector<double> times{0, 0.25, 1};
  EXPECT_EQ(shares_left(setup_of(p), times), (std::vector<double>{1, 0.75, 0}));
  p = bed_of_levels(1);
  (*p.levels.low)[2] = 0, (*p.levels.high)[2] = 2 * spacing;
  const auto below = setup_of(p);
  const std::vector<double> left = shares_left(below, times);
  EXPECT_DOUBLE_EQ(left[0], 1);
  EXPECT_GT(left[1], 0.76);
  EXPECT_LT(left[1], 1);
  EXPECT_EQ(left[2], 0);
}

TEST(Levels, WhatCannotBeIsNamed) {
  const auto keys = [](const Parameters& p) {
    std::vector<std::string> found;
    for (const Problem& problem : check(p)) found.push_back(problem.key);
    return found;
  };
  EXPECT_TRUE(keys(bed_of_levels(1)).empty());
  Parameters p = bed_of_levels(1);
  p.levels.high = std::nullopt;
  EXPECT_EQ(keys(p), (std::vector<std::string>{"levels.high"}));
  p.plate = {.height = -1.0, .slit_left = {}, .slit_right = {}};
  EXPECT_EQ(keys(p).back(), "levels.high") << "with what else is wrong";
  EXPECT_GT(keys(p).size(), 1u);
  p = bed_of_levels(1);
  p.levels.low = p.levels.high = std::nullopt;
  EXPECT_EQ(keys(p), (std::vector<std::string>{"levels.count"}));
  p = bed_of_levels(1);
  (*p.levels.high)[1] = -1;
  EXPECT_EQ(keys(p), (std::vector<std::string>{"levels.high"}));
  p = bed_of_levels(1);
  p.levels.distance = std::nullopt;
  EXPECT_EQ(keys(p), (std::vector<std::string>{"levels.distance"}));
  p = bed_of_levels(1);
  p.sph.smoothing = Smoothing::fixed;
  p.sph.stress_regularisation = 0.2;
  EXPECT_EQ(keys(p), (std::vector<std::string>{"sph.smoothing", "sph.stress_regularisation"}));
  p = bed_of_levels(1);
  p.law = granular::LinearElastic::Parameters{.lambda = 0.8e6, .shear_modulus = 0.6e6};
  EXPECT_EQ(keys(p), (std::vector<std::string>{"law.name"}));
}

}  // namespace
}  // namespace talus::continuum
