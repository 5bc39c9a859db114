// SPDX-License-Identifier: Apache-2.0
/// Parts of particles about the axis of a sector.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "models/continuum/level_cases.hpp"
#include "models/continuum/sector.hpp"
#include "models/continuum/splitting.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

/// r times the sector's angle over bed.spacing.
double arc(const Sector& sector, const Vector3& x) {
  return sector.radius(x) * 2 * std::numbers::pi / sector.copies() / spacing;
}

double mass_ratio_of_all(const State& s) {
  return std::accumulate(s.mass_ratio.begin(), s.mass_ratio.end(), 0.0);
}

TEST(SectorParts, AboutTheAxisABedIsLaidOfParts) {
  for (const double degrees : {90.0, 20.0, 10.0}) {
    const Parameters p = silo_of_parts(degrees);
    ASSERT_THAT(check(p), testing::IsEmpty());
    const State s = initial_state(setup_of(p));
    EXPECT_EQ(mass_ratio_of_all(s), bed_count(Layout(p)));
    std::set<double> parts;
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      parts.insert(s.mass_ratio[i]);
      if (arc(*sector_of(p), s.position[i]) > 1.3) {
        EXPECT_EQ(s.mass_ratio[i], 1) << "relaxed from where it was laid";
      }
    }
    const std::set<double> wanted = degrees == 90   ? std::set{1.0}
                                    : degrees == 20 ? std::set{0.25, 0.5, 1.0}
                                                    : std::set{0.125, 0.25, 0.5};
    EXPECT_EQ(parts, wanted) << degrees;
  }
}

TEST(SectorParts, PartsKeepMassMomentumVolumeAndHistoryOnTheirWayInAndOut) {
  const Parameters p = silo_of_parts(20);
  const auto setup = setup_of(p);
  const Sector sector = *sector_of(p);
  const Levels levels(setup);
  Share alone(one_process());
  State s = initial_state(setup);
  s.velocity.assign(s.position.size(), Vector3{0, 0, -1});
  for (std::size_t i = 0; i < s.position.size(); ++i) s.density[i] *= 1 + 0.01 * double(i % 5);
  s.material.stress[0].assign(s.position.size(), -100.0);
  const auto volume = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i) sum += s.mass_of(i) / s.density[i];
    return sum;
  };
  const auto along_radius = [&](double factor) {
    for (Vector3& x : s.position)
      x = sector.axis() + Vector3{factor * (x.x - sector.axis().x), factor * (x.y - sector.axis().y), x.z};
  };
  const double mass = mass_ratio_of_all(s), space = volume();
  const std::size_t begun = s.position.size();
  const auto expect_kept = [&] {
    EXPECT_EQ(mass_ratio_of_all(s), mass);
    EXPECT_NEAR(volume(), space, 1e-12 * space);
    for (const Vector3& u : s.velocity) EXPECT_NEAR(norm(u - Vector3{0, 0, -1}), 0, 1e-12);
    for (const double stress : s.material.stress[0]) EXPECT_NEAR(stress, -100, 1e-10);
    EXPECT_NEAR(s.merged_energy, 0, 1e-12 * mass * s.mass);
    EXPECT_EQ(std::set<std::int64_t>(s.identity.begin(), s.identity.end()).size(), s.identity.size());
  };
  along_radius(0.4);
  split_and_merge(levels, *setup.boundary, p, alone, s);
  expect_kept();
  const std::size_t inside = s.position.size();
  EXPECT_GT(inside, begun + begun / 2);
  for (const double ratio : s.mass_ratio) EXPECT_EQ(8 * ratio, std::round(8 * ratio));
  EXPECT_EQ(*std::min_element(s.mass_ratio.begin(), s.mass_ratio.end()), 0.125);
  along_radius(2.5);
  for (int n = 0; n < 4; ++n) split_and_merge(levels, *setup.boundary, p, alone, s);
  expect_kept();
  EXPECT_LT(s.position.size(), begun + 2 * (inside - begun) / 3) << "they merge where the ring is wide";
}

TEST(SectorParts, AreForeseenAsTheyAreLaid) {
  for (const double degrees : {20.0, 10.0}) {
    const auto setup = setup_of(silo_of_parts(degrees));
    const double laid = static_cast<double>(initial_state(setup).position.size());
    EXPECT_NEAR(share_of_particles(setup) * bed_count(setup), laid, 0.1 * laid);
    EXPECT_GT(laid, 1.05 * bed_count(setup));
  }
}

TEST(SectorParts, WhatLeavesIsCountedByItsMass) {
  Parameters p = silo_of_parts(20);
  p.gate.opens = GateOpens::from_the_start;
  p.box.floor = FaceKind::open;
  p.removal.below = 4 * spacing;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto value = [&](const std::string& name) {
    for (const NamedValue& v : model.totals())
      if (v.name == name) return v.value;
    ADD_FAILURE() << name;
    return 0.0;
  };
  const double mass = mass_ratio_of_all(s);
  while (s.population.removed < 40) model.advance(team);
  std::set<double> left;
  double outside = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    left.insert(s.mass_ratio[i]);
    if (!model.domain().box().contains(s.position[i])) outside += s.mass_of(i);
  }
  EXPECT_LT(*left.begin(), 1);
  const double removed = value("removed_mass");
  EXPECT_NEAR(removed / (18 * s.mass), mass - mass_ratio_of_all(s), 1e-9 * mass);
  EXPECT_NEAR(value("mass_outside"), 18 * outside, 1e-9 * mass * s.mass);
}

}  // namespace
}  // namespace talus::continuum
