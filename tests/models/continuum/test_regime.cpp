// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/regime.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "models/continuum/cases.hpp"
#include "models/continuum/vessel_parts.hpp"
#include "numerics/run_record.hpp"

namespace talus::continuum {
namespace {

/// The hopper of Yuu & Umekage 2011.
Parameters hopper() {
  Parameters p = as_printed();
  p.box.width = 0.1, p.box.depth = 5e-3, p.box.height = 0.25;
  p.plate.height = 0.1, p.plate.slit_left = 0.03, p.plate.slit_right = 0.07;
  p.bed.spacing = 5e-3 / 3, p.bed.height = 0.25 / 3;
  p.sph.viscosity_alpha = 0.01;
  return p;
}

std::vector<std::string> names(const Parameters& p) {
  std::vector<std::string> names;
  for (const Warning& warning : warnings_of(regime_of_case(setup_of(p)))) names.push_back(warning.id);
  return names;
}
bool warns(const Parameters& p, const std::string& name) {
  const auto all = names(p);
  return std::find(all.begin(), all.end(), name) != all.end();
}

TEST(RegimeOfCase, ThePapersHopperIsWithinItsLaw) {
  EXPECT_TRUE(names(hopper()).empty()) << testing::PrintToString(names(hopper()));
}

TEST(RegimeOfCase, WarnsOfGrainsThatTheLawWasNotFittedTo) {
  Parameters p = hopper();
  for (const double diameter : {1e-3, 1.0, 20e-6}) {
    p.grains.diameter = diameter;
    EXPECT_TRUE(warns(p, "grain-diameter")) << diameter;
  }
  p.grains.diameter = 1e-3;
  p.law = granular::DruckerPrager::Parameters{};
  EXPECT_TRUE(warns(p, "grain-diameter")) << "A4 is a fit too";
  p.law = granular::DruckerPrager::Parameters{.friction = 0.5};
  EXPECT_FALSE(warns(p, "grain-diameter"));
  for (const double diameter : {150e-6, 300e-6}) {
    Parameters near = hopper();
    near.grains.diameter = diameter;
    EXPECT_FALSE(warns(near, "grain-diameter"));
  }
}

TEST(RegimeOfCase, WarnsOfABedUnderPressureBeforeItsWeight) {
  Parameters p = hopper();
  p.law = granular::CriticalState::Parameters{.bulk_modulus = 1e6, .reference_packing = 0.6};
  p.bed.packing = 0.6;
  EXPECT_FALSE(warns(p, "pressure-of-the-bed-at-the-start"));
  p.bed.packing = 0.6004;  // 670 Pa, below the 1200 Pa of its weight
  EXPECT_FALSE(warns(p, "pressure-of-the-bed-at-the-start"));
  p.bed.packing = 0.601;  // 1700 Pa
  EXPECT_TRUE(warns(p, "pressure-of-the-bed-at-the-start"));
  p.bed.packing = 0.55;
  EXPECT_FALSE(warns(p, "pressure-of-the-bed-at-the-start"));
}

TEST(RegimeOfCase, WarnsOfABedThatItsWeightCompresses) {
  Parameters p = hopper();
  const double weight = bulk_density(p) * 9.81 * p.bed.height;
  p.law = granular::LinearElastic::Parameters{.lambda = 21 * weight, .shear_modulus = 1e-3 * weight};
  EXPECT_FALSE(warns(p, "weight-of-the-bed-over-its-modulus"));
  p.law = granular::LinearElastic::Parameters{.lambda = 19 * weight, .shear_modulus = 1e-3 * weight};
  EXPECT_TRUE(warns(p, "weight-of-the-bed-over-its-modulus"));
}

TEST(RegimeOfCase, WarnsOfInletsOfFewLayers) {
  Parameters p = room(20, 20, 20);
  p.bed.height = 0;
  Inlet inlet;
  inlet.centre = {10 * spacing, 10 * spacing, 15 * spacing};
  inlet.width = inlet.depth = 4 * spacing;
  inlet.velocity = {0, 0, -1};
  inlet.to = 1;
  p.inlets = {inlet};
  p.inlets[0].rate = 1;
  const double layer = layer_of(Layout(p), p.inlets[0]).interval;  // kg
  p.inlets[0].rate = 6 * layer;
  EXPECT_FALSE(warns(p, "layers-of-grains-through-inlet-1"));
  p.inlets[0].rate = 4 * layer;
  EXPECT_TRUE(warns(p, "layers-of-grains-through-inlet-1"));
}

TEST(RegimeOfCase, WarnsOfInletsThatAWallCuts) {
  Parameters p = room(20, 20, 20);
  p.bed.height = 0;
  Inlet inlet;
  inlet.centre = {2 * spacing, 10 * spacing, 15 * spacing};
  inlet.width = inlet.depth = 4 * spacing;
  inlet.velocity = {0, 0, -1}, inlet.rate = 1e-3;
  p.inlets = {inlet};
  p.box.left = FaceKind::wall;
  EXPECT_FALSE(warns(p, "window-of-inlet-1-within-the-box")) << "it ends at the wall";
  p.inlets[0].centre[0] = spacing;
  EXPECT_TRUE(warns(p, "window-of-inlet-1-within-the-box"));
  p.box.left = FaceKind::symmetry;
  EXPECT_FALSE(warns(p, "window-of-inlet-1-within-the-box")) << "half a model";
}

TEST(RegimeOfCase, WarnsOfAnOutletTooNarrowForParticlesOrGrains) {
  Parameters p = hopper();
  p.plate.slit_right = 0.03 + 12 * p.bed.spacing;
  EXPECT_FALSE(warns(p, "particles-across-the-outlet"));
  p.plate.slit_right = 0.03 + 5 * p.bed.spacing;
  EXPECT_TRUE(warns(p, "particles-across-the-outlet"));
  EXPECT_FALSE(warns(p, "grains-across-the-outlet"));
  p.grains.diameter = 1e-3;
  EXPECT_TRUE(warns(p, "grains-across-the-outlet"));
  p.plate.slit_left = p.plate.slit_right = std::nullopt;
  EXPECT_FALSE(warns(p, "particles-across-the-outlet")) << "there is no outlet";
}

TEST(RegimeOfCase, WarnsOfAnOpeningOfAPlateLikewise) {
  Parameters p = hopper();
  p.plate = {};
  p.plates = {{.from = {0, 0.1}, .to = {0.1, 0.1}, .openings = {0.04, 0.05}, .opens_after = 0.0}};
  EXPECT_TRUE(warns(p, "particles-across-the-outlet-of-plates-1"));
  p.plates[0].openings = {0.03, 0.07};
  EXPECT_FALSE(warns(p, "particles-across-the-outlet-of-plates-1"));
  p.bed.spacing = 1e-2;
  p.plates[0].openings = {0, 0.1};
  EXPECT_FALSE(warns(p, "particles-across-the-outlet-of-plates-1")) << "all of it is taken away";
}

TEST(RegimeOfCase, SaysWhichSpacingANarrowOutletNeeds) {
  Parameters p = hopper();
  p.plate.slit_right = 0.03 + 6 * p.bed.spacing;
  const auto meaning = [&] {
    for (const RegimeLine& line : regime_of_case(setup_of(p)))
      if (line.quantity == "particles across the outlet") return line.meaning;
    return std::string();
  };
  EXPECT_THAT(meaning(), testing::HasSubstr(fmt::format("bed.spacing = \"{:.3g} mm\"", 500 * p.bed.spacing)));
  p.plate.slit_right = 0.03 + 12 * p.bed.spacing;
  EXPECT_THAT(meaning(), testing::Not(testing::HasSubstr("bed.spacing")));
}

TEST(RegimeOfCase, WarnsOfParticlesSmallerThanAGrain) {
  Parameters p = hopper();
  p.grains.diameter = 1.01 * p.bed.spacing;
  EXPECT_TRUE(warns(p, "particle-spacing-over-grain-diameter"));
}

TEST(RegimeOfCase, WarnsOfABedHeavierThanTheFit) {
  Parameters p = hopper();
  p.bed.height = 10;
  EXPECT_TRUE(warns(p, "weight-of-the-bed-over-its-area"));
  p.law = granular::LinearElastic::Parameters{};
  EXPECT_FALSE(warns(p, "weight-of-the-bed-over-its-area"));
}

TEST(RegimeOfCase, StandsOnTheCardOfTheRun) {
  Parameters p = small_hopper();
  p.grains.diameter = 2 * spacing;
  ThreadTeam team(1);
  const auto of_run = started(p, team).regime(RunRecord{});
  const auto of_case = regime_of_case(setup_of(p));
  ASSERT_GT(of_run.size(), of_case.size());
  for (std::size_t k = 0; k < of_case.size(); ++k) EXPECT_EQ(of_run[k].quantity, of_case[k].quantity);
  EXPECT_TRUE(of_case[0].warning);
}

/// The line of a quantity on a run's card; nothing if the card has none.
std::optional<RegimeLine> line_of(const Continuum& model, const RunRecord& record, const std::string& quantity) {
  for (const RegimeLine& line : model.regime(record))
    if (line.quantity == quantity) return line;
  return std::nullopt;
}

TEST(RegimeOfRun, WarnsOfGradientsBeyondTheRangeOfCollisionsUnlessTheStressEndsThere) {
  Parameters p = small_hopper();
  ThreadTeam team(1);
  const auto line = [&](double shear, double normal) {
    const RunRecord record{
        .series = {},
        .summary = {{"velocity_gradient_shear_max", "1", shear}, {"velocity_gradient_normal_max", "1", normal}}};
    return line_of(started(p, team), record, "velocity gradients over the range of collisions");
  };
  EXPECT_FALSE(line(1, 1)) << "without collisions there is no range";
  p.collisions.form = granular::Collisions::isotropic;
  EXPECT_EQ(line(0.1, 0.02)->value, "0.5");
  EXPECT_FALSE(line(0.1, 0.02)->warning);
  EXPECT_EQ(line(0.3, 0.02)->value, "1.5");
  EXPECT_TRUE(line(0.3, 0.02)->warning);
  EXPECT_EQ(line(0.1, 0.1)->value, "2");
  EXPECT_TRUE(line(0.1, 0.1)->warning);
  EXPECT_FALSE(line(std::nan(""), std::nan(""))->warning) << "there are no snapshots";
  p.collisions.range = granular::CollisionRange::printed;
  EXPECT_EQ(line(0.3, 0.02)->value, "1.5");
  EXPECT_FALSE(line(0.3, 0.02)->warning);
}

TEST(RegimeOfRun, WarnsOfFlowFasterThanTheRangeOfItsLaw) {
  const std::string quantity = "share of flow too fast for the law";
  ThreadTeam team(1);
  EXPECT_FALSE(line_of(started(small_hopper(), team), {}, quantity)) << "the law has no such range";
  Parameters p = small_hopper();
  p.law = granular::CriticalState::Parameters{};
  Continuum model = started(p, team);
  State& s = model.mutable_state();
  const std::size_t count = s.position.size(), fast = count / 5, bearing = count / 2;
  constexpr double pressure = 100;
  // I of 0.31 and 0.29: the fast fifth of all is two fifths of those that bear a pressure.
  const auto rate = [&](double inertial) {
    return inertial / p.grains.diameter * std::sqrt(pressure / p.grains.density);
  };
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t i = 0; i < count; ++i) s.material.stress[c][i] = c < 3 && i < bearing ? pressure : 0;
  for (std::size_t i = 0; i < count; ++i) s.shear_rate[i] = rate(i < fast || i >= bearing ? 0.31 : 0.29);
  const RegimeLine line = *line_of(model, {}, quantity);
  EXPECT_EQ(line.value, fmt::format("{:.3f}", double(fast) / double(bearing)));
  EXPECT_TRUE(line.warning);
  std::fill(s.shear_rate.begin(), s.shear_rate.end(), rate(0.29));
  EXPECT_EQ(line_of(model, {}, quantity)->value, "0.000");
  EXPECT_FALSE(line_of(model, {}, quantity)->warning);
}

TEST(RegimeOfRun, WarnsOfRowsOfTheSeriesFartherApartThanT) {
  const Parameters p = small_hopper();
  const double t = setup_of(p).scales.averaging_time;
  ThreadTeam team(1);
  const auto line = [&](double apart) {
    RunRecord record{};
    record.series = {.names = {"time"}, .units = {"s"}, .columns = {{0, apart, 2 * apart}}};
    return *line_of(started(p, team), record, "time between rows of the series over T/2");
  };
  EXPECT_EQ(line(0.5 * t).value, "1");
  EXPECT_FALSE(line(0.9 * t).warning);
  EXPECT_TRUE(line(1.1 * t).warning);
}

TEST(RegimeOfRun, TheLatticeOfTheStartIsNoLargestPacking) {
  Parameters p = small_hopper();
  ThreadTeam team(1);
  Continuum model = started(p, team);
  // Dense beside walls as laid, 0.62 once it has fallen by a spacing: 45 ms.
  RunRecord record{};
  record.series = {.names = {"time", "packing_max"},
                   .units = {"s", "1"},
                   .columns = {{0, 0.04, 0.05, 0.1}, {0.8, 0.79, 0.62, 0.61}}};
  EXPECT_EQ(line_of(model, record, "largest packing")->value, "0.620");
  EXPECT_FALSE(line_of(model, record, "largest packing")->warning);
  record.series.columns[1] = {0.6, 0.6, 0.6, 0.76};
  EXPECT_TRUE(line_of(model, record, "largest packing")->warning);
  record.series.columns[1] = {0.77, 0.77, 0.776, 0.77};
  EXPECT_FALSE(line_of(model, record, "largest packing")->warning) << "as it was laid";
  // With a bed that settles, from the opening of the gate on.
  model.mutable_state().gate_time = 0.08;
  record.series.columns[1] = {0.8, 0.8, 0.8, 0.6};
  EXPECT_EQ(line_of(model, record, "largest packing")->value, "0.600");
}

TEST(RegimeOfRun, FrozenAirHasNoPressureAndLacksNothing) {
  const auto lines_of_air = [](air::Motion motion) {
    Parameters p = small_hopper();
    p.air.enabled = true;
    p.air.cell = spacing;
    p.air.gas.motion = motion;
    ThreadTeam team(1);
    std::vector<std::string> names;
    for (const RegimeLine& line : started(p, team).regime(RunRecord{}))
      if (line.quantity.starts_with("air's") || line.quantity.starts_with("Reynolds")) names.push_back(line.quantity);
    return names;
  };
  EXPECT_EQ(lines_of_air(air::Motion::frozen), (std::vector<std::string>{"Reynolds number of a grain"}));
  EXPECT_EQ(lines_of_air(air::Motion::flowing),
            (std::vector<std::string>{"air's pressure swing", "air's imbalance", "Reynolds number of a grain"}));
}

}  // namespace
}  // namespace talus::continuum
