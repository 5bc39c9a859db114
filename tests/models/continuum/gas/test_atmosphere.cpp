// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/gas/atmosphere.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <any>
#include <cmath>

#include "models/continuum/cases.hpp"
#include "models/continuum/level_cases.hpp"

namespace talus::continuum {
namespace {

Parameters small_hopper_in_air() {
  Parameters p = small_hopper();
  p.air.enabled = true;
  p.air.cell = spacing;
  return p;
}

std::size_t below(const State& s, double height) {
  return static_cast<std::size_t>(
      std::count_if(s.position.begin(), s.position.end(), [&](const Vector3& x) { return x.z < height; }));
}

TEST(Atmosphere, WhatTheAirGaveIsWhatTheGrainsReceived) {
  for (const Method method : {Method::runge_kutta, Method::leapfrog}) {
    Parameters p = small_hopper_in_air();
    p.integration.method = method;
    ThreadTeam team(1);
    Continuum model = started(p, team);
    while (model.state().time < 0.1) model.advance(team);
    const State& s = model.state();
    EXPECT_GT(below(s, *p.plate.height), 3u);
    EXPECT_GT(norm(s.air.impulse), 0.01 * norm(s.gravity_impulse));
    EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
  }
}

/// Kernels of the particles' own widths put 16 % more and less on the two sides.
TEST(Atmosphere, TheSolidFractionIsEvenAcrossLevels) {
  Parameters p = bed_of_levels(1);
  p.bed.height = p.box.height = 24 * spacing;
  p.levels.distance = 8 * spacing;
  p.levels.low = {0, 0, 0};
  p.levels.high = {4 * spacing, 8 * spacing, 24 * spacing};
  p.air.enabled = true;
  p.air.cell = spacing;
  ThreadTeam team(1);
  const Continuum model = started(p, team);
  const State& s = model.state();
  double least = 1, most = 0;
  for (int i = 0; i < 24; ++i) {
    double mean = 0;
    for (int j = 0; j < 8; ++j)
      for (int k = 8; k < 16; ++k) mean += s.air.solids.fraction[s.air.grid.index(i, j, k)] / 64;
    least = std::min(least, mean / p.bed.packing), most = std::max(most, mean / p.bed.packing);
  }
  EXPECT_GT(least, 0.94);
  EXPECT_LT(most, 1.06);
}

/// Air and grains together, in a closed periodic box without viscosity and gravity.
TEST(Atmosphere, MomentumOfAirAndGrainsStaysInAPeriodicBox) {
  Parameters p = column(6, 4, 6);
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::periodic;
  p.box.height = 12 * spacing;
  p.gravity.acceleration = 0;
  p.air.enabled = true;
  p.air.cell = spacing;
  p.air.gas.boundaries.kind.fill(FlowBoundary::periodic);
  p.air.gas.viscosity = 1e-18;
  p.air.gas.drag = coupling::DragLaw::ergun_wen_yu;
  ThreadTeam team(1);
  Continuum model(p);
  State& s = model.mutable_state();
  for (std::size_t i = 0; i < s.velocity.size(); ++i) s.velocity[i] = {0.3, 0.1 * std::sin(100 * s.position[i].x), -1};
  model.begin(team);
  const auto total = [&] {
    Vector3 sum = momentum(s);
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < s.air.grid.count[2]; ++k)
        for (int j = 0; j < s.air.grid.count[1]; ++j)
          for (int i = 0; i < s.air.grid.count[0]; ++i)
            sum[axis] +=
                s.air.grid.volume() * s.air.flow.momentum[static_cast<std::size_t>(axis)][s.air.grid.index(i, j, k)];
    return sum;
  };
  const Vector3 before = total();
  double exchanged = 0;
  // To the end of one of the air's steps: until then the particles wait for their share of it.
  while (s.air.steps < 30 || s.air.steps_left > 0) {
    model.advance(team);
    exchanged += norm(s.air.force) * s.last_step;
  }
  EXPECT_GT(exchanged, 1e-3 * norm(before));
  EXPECT_LT(norm(total() - before), 1e-12 * norm(before));
}

TEST(Atmosphere, SaysWhatHoldsTheStep) {
  using ::testing::HasSubstr;
  using ::testing::MatchesRegex;
  const auto limit = [](const auto& change) {
    Parameters p = small_hopper_in_air();
    change(p);
    ThreadTeam team(1);
    Continuum model = started(p, team);
    while (model.state().time < 2e-3) model.advance(team);
    return model.step_limit();
  };
  const NumericalError::Report grains = limit([](Parameters& p) { p.air.gas.response = p.air.gas.courant = 1e3; });
  EXPECT_THAT(grains.term, HasSubstr("Courant number of the grains"));
  EXPECT_THAT(grains.place, MatchesRegex("particle [0-9]+ at \\(.*\\) m"));
  const NumericalError::Report drag = limit([](Parameters& p) { p.air.gas.response = 1e-3; });
  EXPECT_THAT(drag.term, HasSubstr("drag on the grains"));
  EXPECT_THAT(drag.place, MatchesRegex("cell \\([0-9]+, [0-9]+, [0-9]+\\) at \\(.*\\) m, solid fraction 0\\.[0-9]+"));
  const NumericalError::Report motion = limit([](Parameters& p) { p.air.gas.courant = 1e-6; });
  EXPECT_THAT(motion.term, HasSubstr("Courant number of the air"));
  EXPECT_THAT(motion.advice, HasSubstr("air.courant"));
}

TEST(Atmosphere, SameBitsForAnyNumberOfThreads) {
  Parameters p = small_hopper_in_air();
  ThreadTeam one(1), two(2);
  Continuum a = started(p, one), b = started(p, two);
  for (int n = 0; n < 40; ++n) a.advance(one), b.advance(two);
  EXPECT_GT(a.state().air.steps, 10u);
  EXPECT_EQ(a.state().velocity, b.state().velocity);
  EXPECT_EQ(a.state().air.acceleration, b.state().air.acceleration);
  EXPECT_EQ(a.state().air.flow.velocity, b.state().air.flow.velocity);
  EXPECT_EQ(a.state().air.flow.pressure, b.state().air.flow.pressure);
  EXPECT_EQ(a.state().air.reynolds_max, b.state().air.reynolds_max);
}

TEST(Atmosphere, AGateOpensForGrainsAndAirAtOnce) {
  Parameters p = small_hopper_in_air();
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.005;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const State& s = model.state();
  const Vector3 slit{0.5 * (*p.plate.slit_left + *p.plate.slit_right), 0.5 * p.box.depth, *p.plate.height};
  const auto through_slit = [&] {
    const Grid& grid = s.air.grid;
    std::array<int, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] = static_cast<int>(slit[axis] / grid.spacing[axis] + 1e-6);
    return s.air.flow.velocity[2][grid.index(cell[0], cell[1], cell[2])];
  };
  const Vector3 up{0, 0, 1e-3};
  while (s.gate_time < 0) {
    EXPECT_TRUE(model.domain().blocks(slit - up, slit + up));
    EXPECT_EQ(through_slit(), 0);
    model.advance(team);
  }
  EXPECT_EQ(model.domain().openings(), 1);
  EXPECT_FALSE(model.domain().blocks(slit - up, slit + up));
  for (int n = 0; n < 20; ++n) model.advance(team);
  EXPECT_NE(through_slit(), 0);
  EXPECT_EQ(model.domain().openings(), 1);
}

/// All that a checkpoint holds, in the order of the list of fields.
std::vector<std::any> kept(const State& state) {
  std::vector<std::any> values;
  for_each_field(
      [&](const FieldInfo& field, const auto& member) {
        if (field.role == FieldRole::kept) values.emplace_back(member);
      },
      state);
  return values;
}

TEST(Atmosphere, AResumedRunTakesTheSameSteps) {
  Parameters p = small_hopper_in_air();
  p.gate.opens = GateOpens::at_time;
  p.gate.time = 0.005;
  ThreadTeam team(1);
  for (const int stop : {1, 47, 200}) {  // before and after the gate, within steps of the air
    Continuum whole = started(p, team);
    for (int n = 0; n < stop; ++n) whole.advance(team);
    Continuum resumed(p);
    const std::vector<std::any> checkpoint = kept(whole.state());
    std::size_t next = 0;
    for_each_field(
        [&](const FieldInfo& field, auto& member) {
          if (field.role == FieldRole::kept) member = std::any_cast<std::decay_t<decltype(member)>>(checkpoint[next++]);
        },
        resumed.mutable_state());
    resumed.resume(team);
    for (int n = 0; n < 150; ++n) whole.advance(team), resumed.advance(team);
    EXPECT_GT(whole.state().gate_time, 0);
    EXPECT_EQ(whole.state().position, resumed.state().position);
    EXPECT_EQ(whole.state().air.acceleration, resumed.state().air.acceleration);
    EXPECT_EQ(whole.state().air.flow.velocity, resumed.state().air.flow.velocity);
    EXPECT_EQ(whole.state().air.flow.pressure, resumed.state().air.flow.pressure);
    EXPECT_EQ(whole.state().air.impulse, resumed.state().air.impulse);
  }
}

/// Particles so far apart, and spread over cells so large, that each grain falls alone: 1.413 m/s for a bead of 200 um.
TEST(Atmosphere, ABeadFallsThroughAirAtRestWithItsTerminalVelocity) {
  Parameters p = free_block(1, 1, 1);
  p.box.width = p.box.depth = 0.2;
  p.box.front = p.box.rear = FaceKind::periodic;
  p.box.height = 6;
  p.bed.left = 0.1 - 0.5e-3, p.bed.right = 0.1 + 0.5e-3;
  p.bed.bottom = 5.9;
  p.bed.height = p.bed.spacing = 1e-3;
  p.bed.packing = 0.1;
  p.box.depth = 1e-3;
  p.air.enabled = true;
  p.air.cell = 0.1;
  p.air.gas.motion = air::Motion::frozen;
  p.air.gas.boundaries.kind[2] = p.air.gas.boundaries.kind[3] = FlowBoundary::periodic;
  p.air.gas.max_step = 0.5e-3;
  p.integration.step = 0.5e-3;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  while (model.state().time < 1.5) model.advance(team);
  EXPECT_NEAR(model.state().velocity[0].z, -1.413, 0.005);
}

/// What the bin's air can do decides how fast grains leave: into a bin whose floor lets the air go, against air that
/// stays where it is, into a closed box whose air has to come up through them.
TEST(Atmosphere, DischargeIsFasterVentedThanAgainstAirAtRestThanSealed) {
  const auto discharged = [](auto&& change) {
    Parameters p = small_hopper_in_air();
    p.integration.method = Method::leapfrog;
    change(p.air);
    ThreadTeam team(1);
    Continuum model = started(p, team);
    while (model.state().time < 0.1) model.advance(team);
    double fallen = 0;  // of the bed's centre of mass
    for (const Vector3& x : model.state().position) fallen -= x.z;
    return fallen / static_cast<double>(model.state().position.size());
  };
  const double start = -(15 + 5) * spacing;
  const double vented = discharged([](auto& air) { air.gas.boundaries.kind[4] = FlowBoundary::open; }) - start;
  const double at_rest = discharged([](auto& air) { air.gas.motion = air::Motion::frozen; }) - start;
  const double sealed = discharged([](auto& air) { air.gas.boundaries.kind[5] = FlowBoundary::no_slip; }) - start;
  EXPECT_GT(vented, 1.2 * at_rest);
  EXPECT_GT(at_rest, 1.2 * sealed);
  EXPECT_GT(sealed, 0);
}

TEST(Atmosphere, APressureThatDoesNotConvergeNamesCellAndResidual) {
  Parameters p = small_hopper_in_air();
  p.air.gas.max_iterations = 1;
  p.air.gas.tolerance = 1e-12;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  try {
    for (int n = 0; n < 100; ++n) model.advance(team);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("pressure"));
    EXPECT_THAT(error.report().place, testing::HasSubstr("cell ("));
    EXPECT_THAT(error.report().term, testing::HasSubstr("residual"));
    EXPECT_EQ(error.report().step, model.state().step);
  }
}

TEST(Atmosphere, CellsThatNobodyChoseMeetThePlate) {
  Parameters p = small_hopper();
  p.air.enabled = true;
  // 0.75 spacings: 66 2/3 layers, 20 below the plate.
  EXPECT_EQ(air_grid(p).count[2], 70);
  EXPECT_TRUE(check_air(p).empty());
  p.plate.height.reset();
  EXPECT_EQ(air_grid(p).count[2], 67);
}

/// The box of cases/slot.toml with another plate and other spacings.
Parameters slot(double plate, double spacing_of_particles) {
  Parameters p = small_hopper_in_air();
  p.box.width = 0.16, p.box.depth = spacing_of_particles, p.box.height = 0.15;
  p.plate = {.height = plate, .slit_left = 0.06, .slit_right = 0.1};
  p.bed.height = 0.112, p.bed.spacing = spacing_of_particles;
  p.air.cell.reset();
  return p;
}

TEST(Atmosphere, CellsThatNobodyChoseAreHalfToOneSpacingHigh) {
  const Grid grid = air_grid(slot(28e-3, 4e-3));
  EXPECT_EQ(grid.count[2], 75);  // 50 would be 0.75 spacings; 28 mm is 14/75 of the height
  EXPECT_TRUE(check(slot(28e-3, 4e-3)).empty());
}

/// Where no cells fit, the error names a size that does, or else a height of the plate.
TEST(CheckAir, ProposesWhatMeetsThePlate) {
  Parameters p = slot(28e-3, 4e-3);
  p.air.cell = 3e-3;
  ASSERT_EQ(check(p).size(), 1u);
  EXPECT_EQ(check(p)[0].allowed, "air.cell = \"2 mm\", of whose faces some lie in the plate");
  p.air.cell = 2e-3;
  EXPECT_TRUE(check(p).empty());

  p = slot(28.31e-3, 4e-3);
  ASSERT_EQ(check(p).size(), 1u);
  EXPECT_EQ(check(p)[0].allowed, "plate.height = \"27 mm\" or \"30 mm\", where faces of the cells are");
  for (const double height : {27e-3, 30e-3}) EXPECT_TRUE(check(slot(height, 4e-3)).empty());
}

TEST(CheckAir, NamesWhatDoesNotFit) {
  Parameters p = small_hopper_in_air();
  EXPECT_TRUE(check(p).empty());
  p.air.cell = 0.7 * spacing;  // of which no faces lie in the plate
  p.air.gas.boundaries.kind[1] = FlowBoundary::periodic;
  std::vector<std::string> keys;
  for (const Problem& problem : check(p)) keys.push_back(problem.key);
  EXPECT_THAT(keys, testing::UnorderedElementsAre("air.right", "air.cell"));
  p.air.enabled = false;
  EXPECT_TRUE(check(p).empty());
}

/// A box without friction in front and behind is uniform along y: cells as deep as it are as good as four in a row.
TEST(Atmosphere, DeepCellsAreAsGoodAsCellsInARow) {
  const auto state = [](std::optional<double> cell_depth) {
    Parameters p = small_hopper_in_air();
    p.box.depth = 4 * spacing;
    p.air.cell_depth = cell_depth;
    p.integration.method = Method::leapfrog;
    EXPECT_TRUE(check(p).empty());
    EXPECT_EQ(air_grid(p).count[1], cell_depth ? 1 : 4);
    ThreadTeam team(1);
    Continuum model = started(p, team);
    while (model.state().time < 0.05) model.advance(team);
    return model.state();
  };
  const State rows = state({}), deep = state(4 * spacing);
  const auto mean_height = [](const State& s) {
    double sum = 0;
    for (const Vector3& x : s.position) sum += x.z;
    return sum / static_cast<double>(s.position.size());
  };
  const double fallen = 20 * spacing - mean_height(rows);
  EXPECT_NEAR(mean_height(deep), mean_height(rows), 0.01 * fallen);
}

TEST(CheckAir, ACellOfAnotherDepthIsCheckedByItsOwnKey) {
  Parameters p = small_hopper_in_air();
  p.box.depth = 4 * spacing;
  p.air.cell_depth = 9 * spacing;
  ASSERT_EQ(check(p).size(), 1u);
  EXPECT_EQ(check(p)[0].key, "air.cell_depth");
  p.air.cell_depth = 4 * spacing;
  p.vessel.push_back({});
  std::vector<std::string> keys;
  for (const Problem& problem : check_air(p)) keys.push_back(problem.key);
  EXPECT_THAT(keys, testing::Contains("air.cell_depth"));
}

}  // namespace
}  // namespace talus::continuum
