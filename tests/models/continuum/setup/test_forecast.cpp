// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/forecast.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "models/continuum/cases.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

/// A section one particle deep, of beads as in the cases.
Parameters section(double width, double height) {
  Parameters p = as_printed();
  p.box.width = width, p.box.depth = 2.5e-3, p.box.height = 1.5 * height;
  p.bed.spacing = 2.5e-3, p.bed.height = height;
  p.settle.damping_time = 5e-3;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  return p;
}

/// The steps until the gate opens and from then on are those of the forecast, within a factor of 1.5 either way.
void expect_forecast(const std::string& name, const Parameters& p, double end) {
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  while (s.gate_time < 0) model.advance(team);
  const auto settling = static_cast<double>(s.step);
  while (s.time < s.gate_time + end) model.advance(team);
  const double flow = static_cast<double>(s.step) - settling;
  const Forecast f = forecast(setup_of(p), end);
  EXPECT_LT(std::abs(std::log(f.settling_steps / settling)), std::log(1.5))
      << name << ": forecast " << f.settling_steps << ", taken " << settling;
  EXPECT_LT(std::abs(std::log(f.flow_steps / flow)), std::log(1.5))
      << name << ": forecast " << f.flow_steps << ", taken " << flow;
}

TEST(ContinuumForecast, OfASettlingBed) {
  expect_forecast("low bed", section(10e-3, 30e-3), 2e-3);
  expect_forecast("high bed", section(10e-3, 100e-3), 2e-3);
}

TEST(ContinuumForecast, OfABedThatGetsItsWeightAtOnce) {
  Parameters p = section(10e-3, 30e-3);
  p.settle.loading_time = 0;
  expect_forecast("at once", p, 2e-3);
}

TEST(Check, ABedThatIsNotLoadedBeforeItsTimeIsOverIsRefused) {
  Parameters p = section(10e-3, 30e-3);
  p.settle.max_time = 1;
  p.settle.loading_time = 0.9;
  EXPECT_TRUE(check(p).empty());
  p.settle.loading_time = 1;
  ASSERT_EQ(check(p).size(), 1u);
  EXPECT_EQ(check(p)[0].key, "settle.loading_time");
}

TEST(ContinuumForecast, OfASofterBedByTheOtherMethod) {
  Parameters p = section(10e-3, 60e-3);
  p.law.of<granular::YuuUmekageIsotropic>().fits.scale = 1.5;
  p.integration.method = Method::runge_kutta;
  p.integration.courant = 0.3;
  p.settle.duration = 5e-3;
  expect_forecast("softer", p, 2e-3);
}

TEST(ContinuumForecast, OfAnUndampedBedIsARange) {
  Parameters p = section(10e-3, 30e-3);
  EXPECT_EQ(forecast(setup_of(p), 1).max_settling_steps, forecast(setup_of(p), 1).settling_steps);
  p.settle.damping_time = std::nullopt;
  p.settle.loading_time = 0;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  while (model.state().gate_time < 0) model.advance(team);
  const auto taken = static_cast<double>(model.state().step);
  const Forecast f = forecast(setup_of(p), 1);
  EXPECT_LE(f.settling_steps, taken);
  EXPECT_GE(f.max_settling_steps, taken);
  EXPECT_GT(f.max_settling_steps, 5 * f.settling_steps);  // no number between them would be honest
}

TEST(ContinuumForecast, OfAGateThatOpensAtATime) {
  Parameters p = section(10e-3, 20e-3);
  p.gate = {.opens = GateOpens::at_time, .time = 3e-3};
  expect_forecast("gate", p, 4e-3);
}

TEST(BedCount, IsTheNumberOfParticlesPlaced) {
  Parameters p = section(100e-3, 100e-3);
  EXPECT_EQ(bed_count(Layout(p)), static_cast<double>(bed_positions(Layout(p)).size()));
  p.box.depth = 10e-3;
  p.wedge = {.half_angle = 0.5, .outlet = 20e-3, .height = 10e-3};
  p.box.height = 250e-3;
  ASSERT_TRUE(check(p).empty());
  const auto placed = static_cast<double>(bed_positions(Layout(p)).size());
  EXPECT_EQ(bed_count(Layout(p)), placed);
  EXPECT_LT(placed, lattice_of(p).positions());
}

TEST(BedCount, OfASectorIsExactWhereThatOfItsWholeWouldTakeLong) {
  Parameters p = silo_of_parts(6);
  p.bed.spacing *= 0.08;
  const Layout layout(p);
  ASSERT_GT(layout.lattice.positions(), 2.1e6);
  EXPECT_EQ(bed_count(layout), static_cast<double>(bed_positions(layout).size()));
}

TEST(BedCount, OfManyParticlesTakesAMoment) {
  Parameters p = section(100e-3, 100e-3);
  p.wedge = {.half_angle = 0.5, .outlet = 20e-3, .height = 10e-3};
  p.box.height = 250e-3;
  const double coarse = bed_count(Layout(p)) / lattice_of(p).positions();
  p.bed.spacing = p.box.depth = 10e-6;  // 10^8 places, of which some are looked at
  EXPECT_NEAR(bed_count(Layout(p)) / lattice_of(p).positions(), coarse, 0.03);
}

TEST(CheckSize, NamesTheLengthOutOfProportion) {
  Parameters p = section(1e6, 30e-3);
  auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "box.width");
  EXPECT_EQ(problems[0].what, "1e+06 m is 4e+08 spacings: the bed would hold 4.8e+09 particles");
  p = section(100e-3, 100e-3);
  p.box.depth = 50e-3, p.bed.spacing = 50e-6;
  problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "bed.spacing");
  EXPECT_EQ(problems[0].what, "0.05 mm makes 4e+09 particles");
  EXPECT_EQ(problems[0].allowed, "at least 0.0794 mm: 1e+09 particles");
}

TEST(CheckSize, CountsTheCellsOfTheAirToo) {
  Parameters p = section(100e-3, 30e-3);
  p.air.enabled = true;
  p.box.height = 1e6;
  auto problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "box.height");
  p.box.height = 100e-3, p.air.cell = 1e-7;
  problems = check(p);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "air.cell");
}

double time_step_of_courant_one(const Parameters& p) {
  return p.bed.spacing / Material(p).sound_speed(bulk_density(p));
}

TEST(CheckSteps, RefusesAStepThatNoRunSurvives) {
  Parameters p = section(10e-3, 30e-3);
  p.integration.step = 2e-6;
  EXPECT_TRUE(check_steps(setup_of(p), 1).empty());
  p.integration.step = 1;
  ASSERT_EQ(check_steps(setup_of(p), 1).size(), 1u);
  EXPECT_EQ(check_steps(setup_of(p), 1)[0].key, "integration.step");
  p.integration.step = 1e-15;
  ASSERT_EQ(check_steps(setup_of(p), 1).size(), 1u);
  p.integration.step.reset();
  EXPECT_EQ(check_steps(setup_of(p), 1e9)[0].key, "run.end");
}

TEST(CheckSteps, AFixedStepThatIsTooLongIsToldAsSuch) {
  Parameters p = column(4, 4, 8);
  p.integration.method = Method::leapfrog;
  p.integration.step = 3 * time_step_of_courant_one(p);
  ThreadTeam team(1);
  Continuum model = started(p, team);
  try {
    while (model.state().step < 5000) model.advance(team);
    FAIL() << "the run survives";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.report().advice, testing::HasSubstr("a smaller integration.step"));
  }
}

TEST(ContinuumSample, OfAVesselHasItsWalls) {
  Parameters p = section(100e-3, 60e-3);
  p.box.depth = 100e-3, p.box.height = 100e-3;
  const Forecast plain = forecast(setup_of(p), 1);
  VesselPart walls, floor;
  walls.shape = VesselShape::box, floor.shape = VesselShape::disc;
  walls.width = walls.depth = 60e-3, walls.bottom = 10e-3, walls.top = 90e-3;
  floor.radius = 50e-3, floor.height = 10e-3;
  p.vessel = {walls, floor};
  ASSERT_TRUE(check(p).empty());
  const double count = bed_count(Layout(p));
  EXPECT_EQ(count, 24. * 24 * 24);
  const Forecast f = forecast(setup_of(p), 1);
  const double area = 4 * 60e-3 * 80e-3 + 3.1416 * 50e-3 * 50e-3;  // of one layer: 6.25e-6 m^2 a particle
  const double of_sets = 1 / 0.16 + 1 / 0.3249 + 1 / 0.64;         // on a square of a spacing
  EXPECT_NEAR(f.wall_points, of_sets * area / 6.25e-6, 0.01 * f.wall_points);
  EXPECT_GE(f.triangles, 8 + 3);
  Forecast drawn = f;
  drawn.triangles += 1e6;  // an STL file of that many alone takes 1.4 GB before the run begins
  EXPECT_GT(memory_of(drawn), 1.4e9);
  EXPECT_LT(memory_of(drawn), memory_of(f) + 2e9);
  EXPECT_GT(memory_of(f) - memory_of(plain), 3500 * (f.particles - plain.particles));
  const Parameters coarse = coarser(Layout(p), count / 8);
  EXPECT_NEAR(bed_count(Layout(coarse)), count / 8, 0.02 * count / 8);
  EXPECT_EQ(coarse.vessel.size(), 2u);
  ThreadTeam team(1);
  Continuum model = started(coarse, team);
  model.advance(team);
}

TEST(ContinuumForecast, OfInletsHasRoomForNoMoreThanTheBoxHolds) {
  Parameters p = section(0.1, 0.05);
  p.box.depth = 0.1, p.box.height = 0.3;
  Inlet inlet;
  inlet.centre = {0.05, 0.05, 0.25}, inlet.velocity = {0, 0, -1}, inlet.width = inlet.depth = 0.02;
  inlet.rate = 0.1, inlet.clock = InletClock::gate;
  p.inlets = {inlet};
  const continuum::Setup setup = setup_of(p);
  const double bed = bed_count(setup), mass = setup.lattice.mass;
  EXPECT_NEAR(forecast(setup, 2).particles, bed + 0.2 / mass, 1) << "as much as comes in";
  EXPECT_NEAR(forecast(setup, 1e6).particles, 0.1 * 0.1 * 0.25 * setup.density / mass, 1) << "the box up to the inlet";
  p.box.floor = FaceKind::open;
  VesselPart pipe;
  pipe.radius = 0.03, pipe.bottom = 0.1, pipe.top = 0.28;
  p.vessel = {pipe};
  EXPECT_NEAR(room_for_inlets(setup_of(p)), 0.06 * 0.06 * 0.15 * setup.density - mass * bed_count(setup_of(p)), 1e-6);
}

TEST(ContinuumSample, StartsWithoutThePlates) {
  Parameters p = small_hopper();
  make_granular(p);
  p.air.enabled = true;
  ASSERT_TRUE(check(p).empty());
  ThreadTeam team(1);
  Continuum model = started(sample(Layout(p), 100), team);
  EXPECT_NEAR(static_cast<double>(model.state().position.size()), 100, 30);
  model.advance(team);
  p.bed.spacing = 0.5e-2;
  EXPECT_NEAR(static_cast<double>(bed_positions(Layout(sample(Layout(p), 1000))).size()), 1000, 250);
}

}  // namespace
}  // namespace talus::continuum
