// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/hopper_observers.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../../models/continuum/cases.hpp"
#include "run/any_model.hpp"

namespace talus::app {
namespace {

double value_of(const std::vector<NamedValue>& values, const std::string& name) {
  return std::find_if(values.begin(), values.end(), [&](const NamedValue& v) { return v.name == name; })->value;
}

TEST(HopperObservers, SeeTheGateAsTheGrainsDo) {
  continuum::Parameters p = continuum::small_hopper();
  p.gate.opens = continuum::GateOpens::at_time;
  p.gate.time = 0.01;
  ThreadTeam team(1);
  const auto model = run::any_model(continuum::Continuum(p));
  model->begin(team);
  const auto slit_velocity = [&] { return value_of(observe_hopper(model->snapshot(), p), "slit_velocity"); };
  double slowest = 0;
  while (model->time() < 0.0095) {
    model->advance(team);
    EXPECT_NEAR(slit_velocity(), 0, 1e-15) << "on a shut gate, which mirrors what is above it";
    slowest = std::min(slowest, value_of(model->totals(), "momentum_z"));
  }
  EXPECT_LT(slowest, 0) << "the bed moves";
  while (model->time() < 0.02) model->advance(team);
  EXPECT_LT(slit_velocity(), -0.01);
}

}  // namespace
}  // namespace talus::app
