// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/shorter_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "small_silo.hpp"

namespace talus::app {
namespace {

/// Whether one of the ways to shorten the run sets this, alone or with others.
bool is_offered(const continuum::Parameters& p, const std::string& setting) {
  const std::vector<Shortening> all = shorter_runs(continuum::Layout(p), 1);
  return std::any_of(all.begin(), all.end(), [&](const Shortening& s) {
    return std::any_of(s.alternatives.begin(), s.alternatives.end(), [&](const std::vector<std::string>& settings) {
      return std::find(settings.begin(), settings.end(), setting) != settings.end();
    });
  });
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
  const auto has_softer = [&] {
    const std::vector<Shortening> all = shorter_runs(continuum::Layout(p), 1);
    return std::any_of(all.begin(), all.end(), [](const Shortening& s) {
      return s.alternatives.front().front().starts_with("law.critical-state.bulk_modulus=");
    });
  };
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 200e6;
  p.law = law;
  EXPECT_TRUE(has_softer());
  law.bulk_modulus = 1e3;
  p.law = law;
  EXPECT_FALSE(has_softer());
}

}  // namespace
}  // namespace talus::app
