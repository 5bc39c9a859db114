// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/shorter_runs.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "small_silo.hpp"

namespace talus::app {
namespace {

/// Whether one of the ways to shorten the run has a setting that begins so.
bool is_offered(const continuum::Parameters& p, const std::string& beginning) {
  for (const Shortening& shortening : shorter_runs(continuum::Layout(p), 1))
    for (const std::vector<std::string>& settings : shortening.alternatives)
      for (const std::string& setting : settings)
        if (setting.starts_with(beginning)) return true;
  return false;
}

TEST(ShorterRuns, SumOverPairsInSinglePrecision) {
  continuum::Parameters p = small_silo();
  EXPECT_TRUE(is_offered(p, "integration.pair_precision=single"));
  p.integration.pair_precision = continuum::PairPrecision::in_single;
  EXPECT_FALSE(is_offered(p, "integration.pair_precision=single"));
}

TEST(ShorterRuns, KeepTwelveParticlesAcrossTheOutlet) {
  continuum::Parameters p = small_silo();  // an outlet of 25.36 mm
  p.bed.spacing = 1e-3;
  EXPECT_TRUE(is_offered(p, "bed.spacing=2.113 mm"));
  EXPECT_FALSE(is_offered(p, "bed.spacing=2.5 mm"));
}

TEST(ShorterRuns, TakeASectorOfAWholeVesselOnly) {
  continuum::Parameters p = small_silo();
  EXPECT_TRUE(is_offered(p, "box.sector=20 deg"));
  p.box.sector = 20 * continuum::half_turn / 180;
  EXPECT_FALSE(is_offered(p, "box.sector=20 deg"));
}

TEST(ShorterRuns, SoftenGrainsThatAreStifferThanDischargeNeeds) {
  continuum::Parameters p = small_silo();
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 200e6;
  p.law = law;
  EXPECT_TRUE(is_offered(p, "law.critical-state.bulk_modulus="));
  law.bulk_modulus = 1e3;
  p.law = law;
  EXPECT_FALSE(is_offered(p, "law.critical-state.bulk_modulus="));
}

}  // namespace
}  // namespace talus::app
