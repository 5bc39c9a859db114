// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace talus {
namespace {

using std::numbers::pi;

/// Air at rest without grains in the paper's box, cells of 1.25 mm.
struct Air {
  GridSnapshot grid{
      .time = 0.2, .step = 0, .count = {80, 2, 200}, .low = {}, .spacing = {1.25e-3, 2.5e-3, 1.25e-3}, .columns = {}};
  std::vector<Vector3> velocity, grains, drag;
  std::vector<double> pressure, fraction;

  Air() {
    velocity.resize(grid.cells());
    grains = drag = velocity;
    pressure.resize(grid.cells());
    fraction = pressure;
  }
  template <class Body>
  void for_each_cell(Body&& body) {
    for (int k = 0; k < grid.count[2]; ++k)
      for (int j = 0; j < grid.count[1]; ++j)
        for (int i = 0; i < grid.count[0]; ++i) body(grid.centre(i, j, k), grid.index(i, j, k));
  }
  GridSnapshot snapshot() const {
    GridSnapshot result = grid;
    result.columns = {{"velocity", "m/s", velocity},
                      {"grain_velocity", "m/s", grains},
                      {"drag", "N/m3", drag},
                      {"pressure", "Pa", pressure},
                      {"solid_fraction", "1", fraction}};
    return result;
  }
};

HopperSetting setting() {
  return {.shape = {.width = 0.1, .depth = 5e-3, .height = 0.25, .plate = {{0.1, 0.03, 0.07}}, .spacing = 1.67e-3},
          .domain = Domain({.low = {}, .high = {0.1, 5e-3, 0.25}, .faces = {}}),
          .particle_mass = 1,
          .particles = 1,
          .grain_density = 2500,
          .grain_diameter = 200e-6,
          .gravity = 9.81};
}

/// A number of the air with no particles around.
double number(HopperRun::Numbers::Number of, const Air& air, const Place& place) {
  const HopperSetting paper = setting();
  HopperSnapshot snapshot(paper, Snapshot{}, 0);
  EXPECT_TRUE(std::isnan(of(snapshot, place))) << "there is no air";
  const GridSnapshot grid = air.snapshot();
  snapshot.air = [&] { return &grid; };
  return of(snapshot, place);
}

TEST(AirNumbers, DragIsComparedWithTheWeightOfTheSameCells) {
  Air air;
  air.for_each_cell([&](const Vector3& x, std::size_t c) {
    const bool counts = x.x > 20e-3 && x.x < 80e-3;
    air.fraction[c] = counts ? 0.6 : 0.1;
    air.drag[c] = {7, 7, counts ? 0.5 * 1500 * 9.81 : 1e6};
  });
  EXPECT_NEAR(number(hopper::drag_to_weight, air, {{"height", 0.12}, {"left", 0.02}, {"right", 0.08}}), 0.5, 1e-12);
}

TEST(AirNumbers, FindsWhereThePressureDropsAndWhereItIsHigher) {
  Air air;
  air.for_each_cell([&](const Vector3& x, std::size_t c) {
    const bool stream = std::abs(x.x - 0.05) < 0.015;
    air.pressure[c] = -10 * std::tanh((x.z - 103e-3) / 5e-3) - (stream ? 3 : 0);
    air.fraction[c] = stream ? 0.4 : 0;
  });
  EXPECT_NEAR(number(hopper::air_pressure_drop_height, air, {{"x", 0.031}, {"from", 0.02}, {"to", 0.19}}), 103e-3,
              1.25e-3);
  EXPECT_NEAR(number(hopper::air_pressure_gradient_at_drop, air, {{"x", 0.031}, {"from", 0.02}, {"to", 0.19}}),
              -10 / 5e-3, 0.03 * 10 / 5e-3);
  EXPECT_NEAR(number(hopper::air_pressure_outside_inside, air, {{"height", 0.05}}), 3, 1e-12);
}

TEST(AirNumbers, TellsThePlugFromWhatIsBesideIt) {
  Air air;
  air.for_each_cell([&](const Vector3& x, std::size_t c) {
    const bool plug = std::abs(x.x - 0.05) < 0.02, creeps = std::abs(x.x - 0.05) < 0.03;
    air.fraction[c] = 0.6;
    air.grains[c] = {0, 0, plug ? -0.2 : creeps ? -0.05 : 0};
    air.velocity[c] = {0, 0, plug ? -0.08 : creeps ? 0.01 : 0.02};
  });
  EXPECT_NEAR(number(hopper::air_velocity_within_plug, air, {{"height", 0.12}}), -0.08, 1e-12);
  EXPECT_NEAR(number(hopper::air_velocity_beside_plug, air, {{"height", 0.12}}), 0.02, 1e-12);
  EXPECT_NEAR(number(hopper::air_velocity_slowness, air, {{"height", 0.12}}), 0.4, 1e-12);
}

TEST(Circulation, OfAVortexIsTheLineIntegralAroundIt) {
  Air air;
  // A vortex in each half of the bin, without flow through their rims.
  const double width = 0.05, height = 0.1, u = 0.3;
  air.for_each_cell([&](const Vector3& x, std::size_t c) {
    const double a = pi * x.x / width, b = pi * x.z / height;
    air.velocity[c] = {u * std::sin(a) * std::cos(b), 0, -u * height / width * std::cos(a) * std::sin(b)};
  });
  // du_x/dz - du_z/dx = -u pi (1/h + h/w^2) sin a sin b; the integral of sin a sin b is 4 w h/pi^2.
  const double exact = -u * pi * (1 / height + height / (width * width)) * 4 * width * height / (pi * pi);
  EXPECT_NEAR(hopper::circulation(air.snapshot(), 0, width, 0, height), exact, 0.01 * std::abs(exact));
  EXPECT_NEAR(hopper::circulation(air.snapshot(), width, 2 * width, 0, height), -exact, 0.01 * std::abs(exact));
  EXPECT_EQ(hopper::circulation(air.snapshot(), 0, width, 0, height, hopper::Cells::filled), 0);
  std::fill(air.fraction.begin(), air.fraction.end(), 0.5);
  EXPECT_EQ(hopper::circulation(air.snapshot(), 0, width, 0, height), 0);
  EXPECT_NEAR(hopper::circulation(air.snapshot(), 0, width, 0, height, hopper::Cells::filled), exact,
              0.01 * std::abs(exact));
}

}  // namespace
}  // namespace talus
