// SPDX-License-Identifier: Apache-2.0
/// The air on several processes against the same on one: every bit, ghosts among them.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "models/air/flow_case.hpp"
#include "ranks/petsc/processes.hpp"

namespace talus::air {
namespace {

struct Setting {
  Grid grid{.count = {130, 2, 36}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}};
  Parameters parameters;
  std::vector<Wall> walls;
  double dt = 1e-4;
};

/// Grains that fall through the lower half, at a step.
Solids grains(const Setting& setting, int step) {
  Solids solids(setting.grid);
  for_each_cell(setting.grid, [&](int i, int j, int k, std::size_t c) {
    if (k > 20) return;
    solids.fraction[c] = 0.3 + 0.2 * std::sin(0.1 * i + 0.4 * j + 0.3 * (k + step));
    for (std::size_t a = 0; a < 3; ++a)
      solids.flux[a][c] = solids.fraction[c] * (a == 2 ? -0.3 : 0.05 * std::sin(0.2 * i + 0.1 * k));
  });
  return solids;
}

/// Without what a process is not told.
Solids known(const Solids& all, const Setting& setting, const Part& part) {
  Solids solids(setting.grid);
  const auto copy = [&](const CellField& from, CellField& to) {
    std::fill(to.begin(), to.end(), std::nan(""));
    for (const RowRange& slab : part.known)
      for (std::size_t row = slab.begin; row < slab.end; ++row) {
        const auto begin =
            static_cast<std::ptrdiff_t>(setting.grid.index(-Grid::margin, static_cast<int>(row) % setting.grid.count[1],
                                                           static_cast<int>(row) / setting.grid.count[1]));
        std::copy_n(from.begin() + begin, setting.grid.length(0), to.begin() + begin);
      }
  };
  copy(all.fraction, solids.fraction);
  for (std::size_t a = 0; a < 3; ++a) copy(all.flux[a], solids.flux[a]);
  return solids;
}

void expect_same_bits(const Setting& setting, bool is_implicit = false) {
  ThreadTeam team;
  AirFlow one(setting.grid, setting.parameters, setting.walls);
  AirFlow shared(setting.grid, setting.parameters, setting.walls, Surface::none(), processes());
  AirState expected(setting.grid), found(setting.grid);
  for (int axis = 0; axis < 3; ++axis)
    for_each_cell(setting.grid, [&](int i, int j, int k, std::size_t c) {
      const auto a = static_cast<std::size_t>(axis);
      expected.velocity[a][c] = found.velocity[a][c] = 0.2 * std::sin(0.11 * i + 0.5 * j + 0.23 * k + axis);
    });
  FaceField impulse = setting.grid.face_field(), own_impulse = impulse;
  CellField outflow = setting.grid.cell_field(), own_outflow = outflow;
  one.begin(team, grains(setting, 0), expected);
  shared.begin(team, grains(setting, 0), found);
  for (int step = 0; step < 4; ++step) {
    const Solids all = grains(setting, step), own = known(all, setting, shared.part());
    EXPECT_EQ(shared.time_step(team, own, found), one.time_step(team, all, expected));
    one.advance(team, setting.dt, all, expected, impulse);
    shared.advance(team, setting.dt, own, found, own_impulse);
    one.add_outflow(team, setting.dt, expected, outflow);
    shared.add_outflow(team, setting.dt, found, own_outflow);
    EXPECT_EQ(shared.iterations(), one.iterations());
    EXPECT_EQ(shared.step_limit(own, found).place, one.step_limit(all, expected).place);
  }
  EXPECT_EQ(one.is_viscosity_implicit(), is_implicit);
  std::vector<CellField*> fields{&found.pressure, &found.pressure_before, &own_outflow};
  std::vector<const CellField*> other{&expected.pressure, &expected.pressure_before, &outflow};
  const auto add = [&](FaceField& of_processes, const FaceField& of_one) {
    for (std::size_t a = 0; a < 3; ++a) fields.push_back(&of_processes[a]), other.push_back(&of_one[a]);
  };
  add(found.velocity, expected.velocity), add(found.momentum, expected.momentum);
  add(found.momentum_before, expected.momentum_before), add(found.drag, expected.drag), add(own_impulse, impulse);
  shared.part().gather(fields);
  if (!processes().is_first()) return;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    std::size_t differing = 0;
    for (std::size_t c = 0; c < fields[f]->size(); ++c) differing += (*fields[f])[c] != (*other[f])[c];
    EXPECT_EQ(differing, 0u) << "field " << f;
  }
}

Setting open_top() {
  Setting setting;
  setting.parameters.boundaries.kind = {FlowBoundary::no_slip,   FlowBoundary::no_slip, FlowBoundary::free_slip,
                                        FlowBoundary::free_slip, FlowBoundary::no_slip, FlowBoundary::open};
  return setting;
}

TEST(AirOnProcesses, OpenTop) {
  expect_same_bits(open_top());
}

TEST(AirOnProcesses, PlateWithASlit) {
  Setting setting = open_top();
  setting.walls = {{"plate", {0, 0, 12e-3}, {130e-3, 0, 12e-3}, {{50e-3, 70e-3}}}};
  setting.parameters.continuity = Continuity::air_alone;
  setting.parameters.formulation = Formulation::model_b;
  expect_same_bits(setting);
}

TEST(AirOnProcesses, OpenOnAllSides) {
  Setting setting;
  setting.parameters.boundaries = all(FlowBoundary::open);
  setting.parameters.boundaries.pressure = {1, 0, 0, 2, 0, 3};
  expect_same_bits(setting);
}

TEST(AirOnProcesses, Inflow) {
  Setting setting = open_top();
  setting.parameters.boundaries.kind[4] = setting.parameters.boundaries.kind[1] = FlowBoundary::inflow;
  setting.parameters.wall_velocity[4] = {0, 0, 0.3}, setting.parameters.wall_velocity[1] = {-0.2, 0, 0};
  setting.parameters.inflow_low = {30e-3, 0, 0};
  expect_same_bits(setting);
}

TEST(AirOnProcesses, Periodic) {
  Setting setting;
  setting.parameters.boundaries = all(FlowBoundary::periodic);
  expect_same_bits(setting);
}

TEST(AirOnProcesses, PeriodicAcross) {
  Setting setting = open_top();
  setting.grid.count = {72, 6, 30};
  for (std::size_t face : {0, 1, 2, 3}) setting.parameters.boundaries.kind[face] = FlowBoundary::periodic;
  expect_same_bits(setting);
}

TEST(AirOnProcesses, ImplicitViscosity) {
  Setting setting = open_top();
  setting.parameters.viscosity = 1e-2;
  setting.parameters.boundaries.wall_velocity[0] = {0, 0, 0.3};
  expect_same_bits(setting, true);
}

TEST(AirOnProcesses, Isothermal) {
  Setting setting = open_top();
  setting.parameters.compressibility = Compressibility::isothermal;
  expect_same_bits(setting);
}

TEST(AirOnProcesses, Frozen) {
  Setting setting = open_top();
  setting.parameters.motion = Motion::frozen;
  expect_same_bits(setting);
}

TEST(AirOnProcesses, FailTogether) {
  const Setting setting = open_top();
  ThreadTeam team;
  AirFlow flow(setting.grid, setting.parameters, {}, Surface::none(), processes());
  AirState state(setting.grid);
  FaceField impulse = setting.grid.face_field();
  flow.begin(team, grains(setting, 0), state);
  Solids solids = grains(setting, 0);
  solids.fraction[setting.grid.index(3, 1, 34)] = 1.5;
  solids.fraction[setting.grid.index(7, 0, 22)] = 1.25;
  try {
    flow.advance(team, setting.dt, known(solids, setting, flow.part()), state, impulse);
    FAIL() << "a fraction is out of range";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.report().what, "the solid fraction is 1.25");
    EXPECT_NE(error.report().place.find("cell (7, 0, 22)"), std::string::npos);
  }
}

}  // namespace
}  // namespace talus::air
