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
