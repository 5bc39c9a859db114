// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/run_forecast.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "app/continuum/hand_formulas.hpp"
#include "models/continuum/model.hpp"
#include "small_silo.hpp"

namespace talus::app {
namespace {

using continuum::Parameters;

Parameters open_silo() {
  Parameters p = small_silo();
  p.bed.spacing = 6e-3, p.bed.height = 60e-3;
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 2e4, law.shear_modulus = 1e4;
  p.law = law;
  p.gate.opens = continuum::GateOpens::from_the_start, p.gate.time = 0;
  p.box.floor = FaceKind::open, p.removal.below = 30e-3;
  return p;
}

continuum::Inlet above_it() {
  continuum::Inlet inlet;
  inlet.centre = {0.05, 0.05, 0.16}, inlet.velocity = {0, 0, -0.2};
  inlet.width = inlet.depth = 0.02, inlet.rate = 0.04;
  return inlet;
}

Forecast::Phase flow(const Parameters& p, double end) {
  run::RunParameters run;
  run.end = end;
  return forecast_of_run(continuum::Setup(p), run).phases.back();
}

TEST(RunForecast, CountsTheParticlesThatAreLeft) {
  const Parameters p = open_silo();
  const continuum::Setup setup(p);
  const double emptied = setup.lattice.mass * continuum::bed_count(setup) / (0.85 * discharge_by_hand(setup));
  const Forecast::Phase whole = flow(p, 2 * emptied);
  EXPECT_NEAR(whole.present, 0.25, 1e-6) << "a line to nothing, then nothing";
  EXPECT_NEAR(whole.evaluations, whole.present * whole.steps, 1e-6 * whole.steps);
  EXPECT_NEAR(flow(p, 0.1 * emptied).present, 0.95, 1e-9);
  Parameters sector = p;
  sector.box.sector = continuum::half_turn / 6;
  EXPECT_NEAR(flow(sector, 0.1 * emptied).present, 0.95, 0.01) << "of its own bed, by its share of the discharge";
  Parameters kept = p;
  kept.box.floor = FaceKind::wall;
  EXPECT_LT(flow(kept, emptied).present, 1) << "what is taken away above the floor";
  kept.removal.below = std::nullopt;
  EXPECT_EQ(flow(kept, emptied).present, 1);
  Parameters metered = p;  // open for half of the time
  metered.vessel.back().closes_after = 0.05 * emptied, metered.vessel.back().repeats_every = 0.1 * emptied;
  EXPECT_NEAR(flow(metered, 4 * emptied).present, flow(p, 2 * emptied).present, 0.01);
}

TEST(RunForecast, CountsTheParticlesThatComeIn) {
  Parameters p = open_silo();
  const continuum::Setup before(p);
  const double mass = before.lattice.mass * continuum::bed_count(before);
  p.inlets = {above_it()};
  EXPECT_NEAR(flow(p, 0.5).present, 1 + 0.5 * 0.5 * 0.04 / mass, 1e-9) << "within its walls they stay";
  p.inlets[0].to = 0.25;
  EXPECT_NEAR(flow(p, 0.5).present, 1 + 0.75 * 0.25 * 0.04 / mass, 1e-9);
  p.vessel[0].bottom = 0.15, p.vessel[0].top = 0.155;
  const double falls = flow(p, 100).present;
  EXPECT_GT(falls, 1);
  EXPECT_LT(falls, 1 + 0.04 * 0.25 / mass) << "nothing holds them";
}

/// Grains are let in above a plate, which does nothing else; by its rise from left to right.
Parameters fed_plate(double rise) {
  Parameters p = open_silo();
  p.bed.height = 0, p.bed.spacing = 3e-3;
  p.box.left = p.box.right = FaceKind::open;
  continuum::VesselPart plate;
  plate.name = "tray", plate.shape = continuum::VesselShape::plate;
  plate.corner = {0.02, -0.1, 0.06}, plate.first_edge = {0.06, 0, rise}, plate.second_edge = {0, 0.3, 0};
  p.vessel = {plate};
  p.inlets = {above_it()};
  p.inlets[0].rate = 0.1, p.inlets[0].width = p.inlets[0].depth = 0.04;
  return p;
}

TEST(RunForecast, StepsOfGrainsThatComeInOntoAPlateTakeTime) {
  ThreadTeam team(1);
  for (const double rise : {0.0, 0.02}) {
    const Parameters p = fed_plate(rise);
    ASSERT_TRUE(continuum::check(p).empty()) << continuum::check(p)[0].what;
    const double step = measure_step(std::make_shared<const continuum::Setup>(p), 0.5, team);
    EXPECT_TRUE(std::isfinite(step) && step > 0) << rise;
  }
}

TEST(RunForecast, GrainsOnAFloorWithinTheBoxStay) {
  Parameters p = fed_plate(0);
  const auto written = [&] {  // by the particles that are there in the mean
    run::RunParameters run;
    run.end = 4, run.snapshots = 0.1, run.series = 1, run.report = false;
    return forecast_of_run(continuum::Setup(p), run).disk_bytes;
  };
  const double run_off = written();
  p.box.left = p.box.right = FaceKind::wall;
  EXPECT_EQ(written(), run_off) << "they fall beside the plate";
  p.vessel[0].corner[0] = -0.1, p.vessel[0].first_edge[0] = 0.3;
  EXPECT_GT(written(), 2 * run_off);
}

TEST(RunForecast, CountsTheListsOfAFall) {
  const auto setup = std::make_shared<const continuum::Setup>(open_silo());
  continuum::Continuum model(setup);
  ThreadTeam team(1);
  model.begin(team);
  while (model.state().time < 0.1) model.advance(team);  // the first grains have come to where they are taken away
  const std::uint64_t steps = model.state().step, builds = model.state().list_builds;
  for (int n = 0; n < 200; ++n) model.advance(team);
  const double taken =
      static_cast<double>(model.state().list_builds - builds) / static_cast<double>(model.state().step - steps);
  EXPECT_LT(std::abs(std::log(list_builds_of_step(*setup) / taken)), std::log(1.5)) << taken;
  Parameters fed = open_silo();
  fed.inlets = {above_it()}, fed.inlets[0].velocity = {0, 0, -1e4};
  EXPECT_EQ(list_builds_of_step(continuum::Setup(fed)), 1);
}

}  // namespace
}  // namespace talus::app
