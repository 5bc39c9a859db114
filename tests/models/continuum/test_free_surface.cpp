// SPDX-License-Identifier: Apache-2.0
/// Densities where a bed faces nothing (docs/design/stabilisation.md).
#include <gtest/gtest.h>

#include <algorithm>

#include "models/continuum/cases.hpp"
#include "models/continuum/step.hpp"

namespace talus::continuum {
namespace {

TEST(Begin, AParticleInAFreeSurfaceIsAsLooseAsItsKernelSays) {
  Parameters p = column(4, 2, 8, 4);
  make_granular(p);
  ThreadTeam team(1);
  const Continuum model = started(p, team);
  const State& s = model.state();
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const double density = s.density[i] / bulk_density(p);
    EXPECT_LE(density, 1);
    if (s.position[i].z > 7 * spacing) {
      EXPECT_NEAR(density, 0.85, 0.01) << "half of the neighbours in the layer above are missing";
    } else {
      EXPECT_NEAR(density, 1, 1e-3);
    }
  }
}

TEST(Begin, WhatBearsTensionIsAsDenseAtItsSurfaceAsWithin) {
  const Parameters p = column(4, 2, 8, 4);
  ThreadTeam team(1);
  const Continuum model = started(p, team);
  for (const double density : model.state().density) EXPECT_EQ(density, bulk_density(p));
}

TEST(Advance, WhatLayOnAGateIsLooserWithoutIt) {
  Parameters p = small_hopper();
  make_granular(p);
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.01;
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  std::vector<double> before;
  while (s.gate_time < 0) {
    before = by_identity(s, s.density);
    model.advance(team);
  }
  const auto after = by_identity(s, s.density);
  const auto position = by_identity(s, s.position);
  std::size_t looser = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const Vector3& x = position[i];
    const bool lay_on_it =
        x.z < p.plate.height.value() + spacing && x.x > *p.plate.slit_left && x.x < *p.plate.slit_right;
    EXPECT_NEAR(after[i] / before[i], lay_on_it ? 0.85 : 1, lay_on_it ? 0.05 : 0.02) << x.x << ' ' << x.z;
    looser += lay_on_it;
  }
  EXPECT_EQ(looser, 8u);
}

TEST(Advance, WhatFliesApartThinsOutUntilTheKernelIsThreeTimesAsWide) {
  Parameters p = free_block(4, 4, 4);
  make_granular(p);
  p.gravity.acceleration = 0;
  ThreadTeam team(1);
  Continuum model(p);
  State& s = model.mutable_state();
  const Vector3 middle{0.5, 0.5 * p.box.depth, 5 + 2 * spacing};
  for (std::size_t i = 0; i < s.position.size(); ++i) s.velocity[i] = 50 * (s.position[i] - middle);
  model.begin(team);
  while (s.time < 0.1) model.advance(team);  // six times as far apart
  const double least = *std::min_element(s.density.begin(), s.density.end());
  EXPECT_DOUBLE_EQ(least, bulk_density(p) / 27);
}

TEST(Advance, ABuriedSurfaceIsAsDenseAsTheGrainsAroundIt) {
  Parameters p = small_hopper();
  make_granular(p);
  ThreadTeam team(2);
  Continuum model = started(p, team);
  const State& s = model.state();
  const auto start = by_identity(s, s.position);
  while (s.time < 0.6) model.advance(team);
  const double surface = p.plate.height.value() + p.bed.height - spacing;
  double looser = 0;
  std::size_t buried = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (start[static_cast<std::size_t>(s.identity[i])].z > surface && s.packing[i] > 0.45)
      ++buried, looser += s.density[i] / p.grains.density - s.packing[i];
  ASSERT_GT(buried, 6u);
  EXPECT_NEAR(looser / double(buried), 0, 0.02);
}

}  // namespace
}  // namespace talus::continuum
