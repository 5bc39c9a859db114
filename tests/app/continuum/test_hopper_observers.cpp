// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/hopper_observers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../models/continuum/cases.hpp"
#include "analysis/particle_field.hpp"
#include "models/continuum/layout.hpp"
#include "models/continuum/time_scale.hpp"
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

void expect_probes_of_all(const continuum::Parameters& p) {
  ThreadTeam team(1);
  const auto model = run::any_model(continuum::Continuum(p));
  model->begin(team);
  while (model->time() < 0.02) model->advance(team);
  const Snapshot snapshot = model->snapshot();
  const auto outlet = continuum::outlet_of(p);
  ASSERT_TRUE(outlet.has_value());
  const auto density = snapshot.scalars("density");
  const ParticleField all(
      particles_of_density(snapshot.positions(), density, continuum::lattice_of(p).mass, p.grains.density),
      *snapshot.domain);
  const Vector3 slit{0.5 * (outlet->left + outlet->right), 0.5 * p.box.depth, outlet->height};
  const auto values = observe_hopper(snapshot, p);
  const double velocity = all.value(slit, snapshot.vectors("velocity")).z;
  const double above = all.value(slit + Vector3{0, 0, 0.125 * continuum::outlet_width(p).value()}, density);
  ASSERT_LT(velocity, 0);
  EXPECT_NEAR(value_of(values, "slit_velocity"), velocity, -1e-12 * velocity);
  EXPECT_NEAR(value_of(values, "probe_density"), above, 1e-12 * above);
}

TEST(HopperObservers, ProbesTakeAllThatReachesThem) {
  continuum::Parameters p = continuum::small_hopper();
  expect_probes_of_all(p);
  p.plate = {};
  p.wedge = {.half_angle = 0.5, .outlet = 4 * continuum::spacing, .height = 15 * continuum::spacing};
  p.box.height = 60 * continuum::spacing;
  expect_probes_of_all(p);
}

}  // namespace
}  // namespace talus::app
