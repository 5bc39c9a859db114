// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/hopper_observers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../models/continuum/cases.hpp"
#include "../../models/continuum/vessel_parts.hpp"
#include "analysis/particle_field.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/setup/time_scale.hpp"
#include "run/any_model.hpp"

namespace talus::app {
namespace {

double value_of(const std::vector<NamedValue>& values, const std::string& name) {
  return std::find_if(values.begin(), values.end(), [&](const NamedValue& v) { return v.name == name; })->value;
}

std::vector<NamedValue> observe_hopper(const Snapshot& all, const continuum::Layout& layout) {
  return app::observe_hopper([&](const auto& take) { take(all); }, layout);
}

TEST(HopperObservers, SeeTheGateAsTheGrainsDo) {
  continuum::Parameters p = continuum::small_hopper();
  p.gate.opens = continuum::GateOpens::at_time;
  p.gate.time = 0.01;
  ThreadTeam team(1);
  const auto model = run::any_model(continuum::Continuum(p));
  model->begin(team);
  const auto slit_velocity = [&] {
    return value_of(observe_hopper(model->snapshot(), continuum::Layout(p)), "slit_velocity");
  };
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
  const auto outlet = continuum::Layout(p).outlet;
  ASSERT_TRUE(outlet.has_value());
  const auto density = snapshot.scalars("density");
  const ParticleField all(
      particles_of_density(snapshot.positions(), density, continuum::lattice_of(p).mass, p.grains.density),
      *snapshot.domain);
  const Vector3 slit{0.5 * (outlet->left + outlet->right), 0.5 * p.box.depth, outlet->height};
  ASSERT_EQ(outlet->middle_y, slit.y);
  const auto values = observe_hopper(snapshot, continuum::Layout(p));
  const double velocity = all.value(slit, snapshot.vectors("velocity")).z;
  const double above = all.value(slit + Vector3{0, 0, 0.125 * continuum::outlet_width_of(p).value()}, density);
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

TEST(HopperObservers, EachOfSeveralOutletsHasARate) {
  using continuum::spacing;
  continuum::Parameters p = continuum::room(20, 20, 24);
  p.vessel = {continuum::plate("west", {2, 2, 10}, {6, 0, 0}, {0, 6, 0}),
              continuum::plate("east", {12, 12, 12}, {4, 0, 0}, {0, 6, 0})};
  PointSet points;
  std::vector<Vector3> places, velocities;
  const auto fill = [&](const Vector3& corner, int width, double speed) {
    for (double x = 0.5; x < width; ++x)
      for (double y = 0.5; y < 6; ++y)
        for (double z = 4.5; z < 20; ++z) {
          places.push_back(spacing * (Vector3{x, y, z} + corner));
          velocities.push_back({0, 0, -speed});
        }
  };
  fill({2, 2, 0}, 6, 0.1), fill({12, 12, 0}, 4, 0.3);
  const std::vector<double> zero(places.size(), 0), density(places.size(), continuum::bulk_density(p));
  points.columns = {{"position", "m", places},
                    {"velocity", "m/s", velocities},
                    {"density", "kg/m3", density},
                    {"stress_zz", "Pa", zero},
                    {"strain", "1", zero}};
  const Domain domain = continuum::Boundary(p).domain();
  Snapshot snapshot = points.view();
  snapshot.domain = &domain;
  const auto has = [&](const std::vector<NamedValue>& values, const std::string& name) {
    return std::any_of(values.begin(), values.end(), [&](const NamedValue& v) { return v.name == name; });
  };
  for (continuum::VesselPart& part : p.vessel) part.gate = true;
  const auto values = observe_hopper(snapshot, continuum::Layout(p));
  const double column = continuum::lattice_of(p).mass / spacing;  // of one row of particles
  EXPECT_NEAR(value_of(values, "discharge_rate_west"), 36 * column * 0.1, 1e-9 * column);
  EXPECT_NEAR(value_of(values, "discharge_rate_east"), 24 * column * 0.3, 1e-9 * column);
  EXPECT_NEAR(value_of(values, "slit_velocity"), -0.1, 1e-9) << "of the lowest, where it is along y too";
  p.vessel.pop_back();
  EXPECT_FALSE(has(observe_hopper(snapshot, continuum::Layout(p)), "discharge_rate_west")) << "one is all";
}

}  // namespace
}  // namespace talus::app
