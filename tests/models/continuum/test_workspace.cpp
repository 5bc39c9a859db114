// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/workspace.hpp"

#include <gtest/gtest.h>

#include "models/continuum/cases.hpp"

namespace talus::continuum {
namespace {

TEST(Evaluate, TheViscosityOfSettlingEndsAtTheOpening) {
  Parameters p = small_hopper();
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.01;
  p.sph.viscosity_alpha = p.settle.viscosity_alpha.emplace(0.2);
  ThreadTeam team(1);
  Continuum same = started(p, team);
  p.sph.viscosity_alpha = 0.01;
  Continuum less = started(p, team);
  while (same.state().gate_time < 0) same.advance(team), less.advance(team);
  EXPECT_EQ(same.state().velocity, less.state().velocity);
  for (int n = 0; n < 2; ++n) same.advance(team), less.advance(team);
  EXPECT_NE(same.state().velocity, less.state().velocity);
}

}  // namespace
}  // namespace talus::continuum
