// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/contact_memory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "physics/granular/appendix_b.hpp"
#include "physics/granular/material_path.hpp"

namespace talus::granular {
namespace {

constexpr double apart = 0.05, pressed = 3e-4;

std::vector<AnyLaw> laws(Volume volume, double compaction = 0) {
  return {make_law(YuuUmekageIsotropic::Parameters{.contact = {.volume = volume, .compaction = compaction}}, 2500),
          make_law(YuuUmekagePrinted::Parameters{.contact = {.volume = volume, .compaction = compaction}}, 2500),
          make_law(DruckerPrager::Parameters{.contact = {.volume = volume, .compaction = compaction}}, 2500)};
}
double mean(const SymmetricTensor3<>& stress) {
  return trace(stress) / 3;
}
double dilation(const AnyLaw& law, const PathPoint& point) {
  const auto slots = history_of(law);
  for (std::size_t k = 0; k < slots.size(); ++k)
    if (slots[k].name == std::string_view("dilation")) return point.history[k];
  return -1;
}

TEST(ContactMemory, GrainsThatCameApartTouchWhereTheyAreWhenPressedAgain) {
  const std::vector<PathStretch> path = {{1, squeeze(-apart)}, {1, squeeze(pressed)}};
  const auto fresh = laws(Volume::contact);
  for (const AnyLaw& law : fresh) {
    const double first = mean(follow_path(law, std::vector<PathStretch>{{1, squeeze(pressed)}}).back().stress);
    const auto points = follow_path(law, path, {.points = 1});
    EXPECT_EQ(points[1].stress, SymmetricTensor3<>{});
    EXPECT_NEAR(dilation(law, points[2]), apart / 3, 1e-9);
    // As much pressure as from the reference packing, but for the factor of the density, which Drucker-Prager has not.
    const double factor = &law == &fresh.back() ? 1 : std::exp(-apart);
    EXPECT_NEAR(mean(points[2].stress) / first, factor, 2e-3);
  }
  for (const AnyLaw& law : laws(Volume::density)) EXPECT_EQ(mean(follow_path(law, path).back().stress), 0);
}

TEST(ContactMemory, BelowTheGateThereIsNothingToRemember) {
  const double gate = std::log(0.6 / 0.5);
  for (const AnyLaw& law : laws(Volume::contact)) {
    const auto points = follow_path(
        law,
        std::vector<PathStretch>{{1, squeeze(-0.3)}, {1, squeeze(0.3 - gate - 1e-4)}, {1, squeeze(1e-4 + pressed)}},
        {.points = 1});
    EXPECT_NEAR(dilation(law, points[1]), gate / 3, 1e-12);
    EXPECT_EQ(mean(points[2].stress), 0);
    EXPECT_GT(mean(points[3].stress), 100);
  }
}

TEST(ContactMemory, ShearPacksThemAgainExponentially) {
  const double k = 3, sheared = 1e-3;
  for (const AnyLaw& law : laws(Volume::contact, k)) {
    const auto points = follow_path(
        law, std::vector<PathStretch>{{1, squeeze(-apart)}, {1, squeeze(2e-3)}, {1, shear(sheared)}}, {.points = 1});
    EXPECT_NEAR(dilation(law, points[2]), apart / 3, 1e-9);
    EXPECT_NEAR(dilation(law, points[3]) / dilation(law, points[2]), std::exp(-k * sheared), 1e-7);
    EXPECT_LT(mean(points[3].stress), mean(points[2].stress));
  }
}

/// Sheared without end they are at the reference packing's dilation, and no looser grains keep a pressure.
TEST(ContactMemory, ThereIsNoPressureBelowTheReferencePackingAfterLongShear) {
  for (const AnyLaw& law : laws(Volume::contact, 3)) {
    const auto points =
        follow_path(law, std::vector<PathStretch>{{1, squeeze(-apart)}, {1, squeeze(pressed)}, {1, shear(0.1)}},
                    {.max_increment = 1e-5, .points = 1});
    EXPECT_LT(mean(points[3].stress), 0.01 * mean(points[2].stress));
  }
}

TEST(ContactMemory, AClosedCycleGivesNoEnergy) {
  const std::vector<PathStretch> cycle = {{1, squeeze(-apart)}, {1, squeeze(pressed)}, {1, shear(2e-3)},
                                          {1, squeeze(apart)},  {1, shear(-2e-3)},     {1, squeeze(-pressed)}};
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.contact = {.volume = Volume::contact}}, 2500);
  EXPECT_GT(work_of_path(cycle, follow_path(law, cycle, {.max_increment = 1e-5, .points = 3000})), 0);
}

}  // namespace
}  // namespace talus::granular
