// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/regime.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "models/continuum/cases.hpp"
#include "numerics/warning.hpp"

namespace talus::continuum {
namespace {

/// The hopper of Yuu & Umekage 2011.
Parameters hopper() {
  Parameters p;
  p.box.width = 0.1, p.box.depth = 5e-3, p.box.height = 0.25;
  p.plate.height = 0.1, p.plate.slit_left = 0.03, p.plate.slit_right = 0.07;
  p.bed.spacing = 5e-3 / 3, p.bed.height = 0.25 / 3;
  return p;
}

std::vector<std::string> names(const Parameters& p) {
  std::vector<std::string> names;
  for (const Warning& warning : warnings_of(regime_of_case(p))) names.push_back(warning.id);
  return names;
}
bool warns(const Parameters& p, const std::string& name) {
  const auto all = names(p);
  return std::find(all.begin(), all.end(), name) != all.end();
}

TEST(RegimeOfCase, ThePapersHopperIsWithinItsLaw) {
  EXPECT_TRUE(names(hopper()).empty()) << testing::PrintToString(names(hopper()));
}

TEST(RegimeOfCase, WarnsOfGrainsThatTheLawWasNotFittedTo) {
  Parameters p = hopper();
  for (const double diameter : {1e-3, 1.0, 20e-6}) {
    p.grains.diameter = diameter;
    EXPECT_TRUE(warns(p, "grain-diameter")) << diameter;
  }
  p.grains.diameter = 1e-3;
  p.law = granular::DruckerPrager::Parameters{};
  EXPECT_TRUE(warns(p, "grain-diameter")) << "A4 is a fit too";
  p.law = granular::DruckerPrager::Parameters{.friction = 0.5};
  EXPECT_FALSE(warns(p, "grain-diameter"));
  for (const double diameter : {150e-6, 300e-6}) {
    Parameters near = hopper();
    near.grains.diameter = diameter;
    EXPECT_FALSE(warns(near, "grain-diameter"));
  }
}

TEST(RegimeOfCase, WarnsOfAnOutletTooNarrowForParticlesOrGrains) {
  Parameters p = hopper();
  p.plate.slit_right = 0.03 + 12 * p.bed.spacing;
  EXPECT_FALSE(warns(p, "particles-across-the-outlet"));
  p.plate.slit_right = 0.03 + 5 * p.bed.spacing;
  EXPECT_TRUE(warns(p, "particles-across-the-outlet"));
  EXPECT_FALSE(warns(p, "grains-across-the-outlet"));
  p.grains.diameter = 1e-3;
  EXPECT_TRUE(warns(p, "grains-across-the-outlet"));
  p.plate.slit_left = p.plate.slit_right = std::nullopt;
  EXPECT_FALSE(warns(p, "particles-across-the-outlet")) << "there is no outlet";
}

TEST(RegimeOfCase, WarnsOfParticlesSmallerThanAGrain) {
  Parameters p = hopper();
  p.grains.diameter = 1.01 * p.bed.spacing;
  EXPECT_TRUE(warns(p, "particle-spacing-over-grain-diameter"));
}

TEST(RegimeOfCase, WarnsOfABedHeavierThanTheFit) {
  Parameters p = hopper();
  p.bed.height = 10;
  EXPECT_TRUE(warns(p, "weight-of-the-bed-over-its-area"));
  p.law = granular::LinearElastic::Parameters{};
  EXPECT_FALSE(warns(p, "weight-of-the-bed-over-its-area"));
}

TEST(RegimeOfCase, StandsOnTheCardOfTheRun) {
  Parameters p = small_hopper();
  p.grains.diameter = 2 * spacing;
  ThreadTeam team(1);
  const auto of_run = started(p, team).regime(RunRecord{});
  const auto of_case = regime_of_case(p);
  ASSERT_GT(of_run.size(), of_case.size());
  for (std::size_t k = 0; k < of_case.size(); ++k) EXPECT_EQ(of_run[k].quantity, of_case[k].quantity);
  EXPECT_TRUE(of_case[0].warning);
}

TEST(RegimeOfRun, FrozenAirHasNoPressureAndLacksNothing) {
  const auto lines_of_air = [](air::Motion motion) {
    Parameters p = small_hopper();
    p.air.enabled = true;
    p.air.cell = spacing;
    p.air.gas.motion = motion;
    ThreadTeam team(1);
    std::vector<std::string> names;
    for (const RegimeLine& line : started(p, team).regime(RunRecord{}))
      if (line.quantity.starts_with("air's") || line.quantity.starts_with("Reynolds")) names.push_back(line.quantity);
    return names;
  };
  EXPECT_EQ(lines_of_air(air::Motion::frozen), (std::vector<std::string>{"Reynolds number of a grain"}));
  EXPECT_EQ(lines_of_air(air::Motion::flowing),
            (std::vector<std::string>{"air's pressure swing", "air's imbalance", "Reynolds number of a grain"}));
}

}  // namespace
}  // namespace talus::continuum
