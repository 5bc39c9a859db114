// SPDX-License-Identifier: Apache-2.0
/// The air among grains.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "base/random.hpp"
#include "flow_case.hpp"

namespace talus::air {
namespace {

TEST(AirFlow, PressureDropOfAFixedBedIsThatOfTheDragLaw) {
  for (const auto& [law, formulation, drop] : fixed_beds) {
    Parameters p;
    p.drag = law;
    p.formulation = formulation;
    p.boundaries = all(FlowBoundary::free_slip);
    p.boundaries.kind[4] = p.boundaries.kind[5] = FlowBoundary::open;
    const int n = 16;
    const double h = 1.25e-3;
    p.boundaries.pressure[4] = drop * n * h;
    Case c({.count = {2, 2, n}, .low = {}, .spacing = {h, h, h}}, p);
    c.set_solids(0, n, 0.6, {});
    c.begin();
    c.advance(100e-6, 40);
    const double superficial = 0.4 * c.state.velocity[2][c.grid.index(1, 1, n / 2)];
    EXPECT_NEAR(superficial, 0.01, 1e-4);
    const double gradient =
        (c.state.pressure[c.grid.index(0, 0, 12)] - c.state.pressure[c.grid.index(0, 0, 3)]) / (9 * h);
    EXPECT_NEAR(gradient, -drop, 2e-3 * drop);
    // The grains receive the whole pressure gradient: in model A drag and their own share of it.
    EXPECT_NEAR(0.6 * c.impulse[2][c.grid.index(1, 0, 8)] / 100e-6, drop, 2e-3 * drop);
  }
}

TEST(AirFlow, SlipDecaysAtTheDragsRate) {
  Parameters p;
  p.boundaries = all(FlowBoundary::periodic);
  p.viscosity = 1.82e-5;
  Case c({.count = {4, 2, 4}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
  c.set_solids(0, 4, 0.6, {0, 0, 0.2});
  c.set_velocity([](const Vector3&) { return Vector3{0, 0, 0.2 + 1e-6}; });  // so slow that the drag is Stokes'
  c.begin();
  const double beta = coupling::drag_coefficient(p.drag, p.medium(), 0.6, 0), t_slip = p.density() * 0.4 / beta;
  EXPECT_NEAR(t_slip, 15e-6, 0.5e-6);
  // In a periodic box the mixture's flow stays, so a pressure gradient has nothing to say: the slip decays freely.
  const double dt = 40e-6;
  c.advance(dt);
  const double slip = c.state.velocity[2][c.grid.index(1, 1, 1)] - 0.2;
  EXPECT_NEAR(slip / 1e-6, std::exp(-dt / t_slip), 1e-4);
}

/// Grains and air at random in a periodic box: solids that fill some of it and move each their way.
struct Mixture : Case {
  explicit Mixture(const Parameters& p, int threads = 1)
      : Case({.count = {12, 4, 16}, .low = {}, .spacing = {1.25e-3, 1.25e-3, 1.25e-3}}, p, {}, threads) {
    Random random(11);
    for_each_cell(grid, [&](int, int, int k, std::size_t i) {
      const double s = k < 8 ? random.uniform(0.3, 0.6) : k < 10 ? random.uniform(0, 1e-6) : 0;
      solids.fraction[i] = s;
      for (auto& flux : solids.flux) flux[i] = s * random.uniform(-0.5, 0.5);
    });
    set_velocity([&](const Vector3& x) {
      return Vector3{0.5 * std::sin(x.z * 300), 0.1, 0.7 * std::cos(x.x * 400) + random.uniform(-0.1, 0.1)};
    });
    begin();
  }
};

Vector3 received(const Case& c) {
  Vector3 total;
  for_each_cell(c.grid, [&](int, int, int, std::size_t i) {
    for (int a = 0; a < 3; ++a)
      total[a] += c.grid.volume() * c.solids.fraction[i] * c.impulse[static_cast<std::size_t>(a)][i];
  });
  return total;
}

/// Without viscosity, whose printed form is no divergence where the void fraction varies; the drag is then Ergun's
/// inertial part.
TEST(AirFlow, WithoutViscosityTheMomentumOfAirAndGrainsStays) {
  Parameters p;
  p.boundaries = all(FlowBoundary::periodic);
  p.viscosity = 1e-18;
  p.drag = coupling::DragLaw::ergun_wen_yu;
  for (const auto& [upwind, formulation] :
       {std::pair{0.0, Formulation::model_a}, {0.5, Formulation::model_a}, {0.5, Formulation::model_b}}) {
    p.upwind = upwind;
    p.formulation = formulation;
    Mixture c(p);
    const Vector3 start = c.momentum();
    Vector3 grains;
    double exchanged = 0;
    for (int step = 0; step < 10; ++step) {
      c.advance(30e-6);
      grains += received(c);
      exchanged += norm(received(c));
    }
    EXPECT_GT(exchanged, 0.5 * norm(start));
    EXPECT_LT(norm(c.momentum() - start + grains), 1e-12 * exchanged);
  }
}

/// One step in which only drag and pressure act: uniform air, solids of one velocity.
TEST(AirFlow, ExchangeIsEqualAndOppositeToRoundOff) {
  Parameters p;
  p.boundaries = all(FlowBoundary::periodic);
  Case c({.count = {8, 4, 8}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
  c.set_solids(0, 8, 0.5, {0.3, 0, -0.4});
  c.set_velocity([](const Vector3&) { return Vector3{1, 0.5, 2}; });
  c.begin();
  const Vector3 start = c.momentum();
  c.advance(50e-6);
  const Vector3 sum = c.momentum() - start + received(c);
  EXPECT_GT(norm(received(c)), 0.9 * norm(start) / 3);
  EXPECT_LT(norm(sum), 1e-12 * norm(start));
}

TEST(AirFlow, MixtureHasNoDivergence) {
  Parameters p;
  p.boundaries = all(FlowBoundary::no_slip);
  p.boundaries.kind[5] = FlowBoundary::open;
  p.boundaries.kind[2] = p.boundaries.kind[3] = FlowBoundary::periodic;
  Mixture c(p);
  const double before = c.flow.max_divergence(c.solids, c.state);
  c.advance(50e-6);
  EXPECT_LT(c.flow.max_divergence(c.solids, c.state), 1e-4 * before);
}

/// Grains fall from one half of a closed box into the other, through an opening beside them.
TEST(AirFlow, ChangesPlacesWithGrainsOrIsBoundByItselfAlone) {
  for (const Continuity continuity : {Continuity::mixture, Continuity::air_alone}) {
    Parameters p;
    p.boundaries = all(FlowBoundary::no_slip);
    p.continuity = continuity;
    p.tolerance = 1e-10;
    Case c({.count = {8, 4, 12}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
    for_each_cell(c.grid, [&](int i, int, int k, std::size_t n) {
      if (i >= 4 || k < 2 || k >= 10) return;
      c.solids.fraction[n] = 0.4;
      c.solids.flux[2][n] = 0.4 * -0.5;
    });
    c.begin();
    c.advance(50e-6, 3);
    EXPECT_LT(c.flow.max_divergence(c.solids, c.state), 1e-4);
    double air = 0, grains = 0, upwards_beside = 0;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 8; ++i) {
        const std::size_t f = c.grid.index(i, j, 6);
        air += (1 - c.solids.fraction[f]) * c.state.velocity[2][f];
        grains += c.solids.flux[2][f];
        if (i >= 4) upwards_beside += c.state.velocity[2][f];
      }
    EXPECT_NEAR(air, continuity == Continuity::mixture ? -grains : 0, 1e-6 * std::abs(grains));
    EXPECT_GT(upwards_beside, 0);
  }
}

TEST(AirFlow, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const double viscosity : {1.82e-5, 1e-2}) {  // explicit and implicit
    Parameters p;
    p.boundaries = all(FlowBoundary::no_slip);
    p.boundaries.kind[5] = FlowBoundary::open;
    p.boundaries.kind[2] = p.boundaries.kind[3] = FlowBoundary::periodic;
    p.viscosity = viscosity;
    Mixture one(p, 1), two(p, 2);
    one.advance(50e-6, 3), two.advance(50e-6, 3);
    EXPECT_EQ(one.flow.is_viscosity_implicit(), viscosity > 1e-3);
    EXPECT_EQ(one.state.velocity, two.state.velocity);
    EXPECT_EQ(one.state.pressure, two.state.pressure);
    EXPECT_EQ(one.impulse, two.impulse);
  }
}

/// A shaft open above and below, with 5 Pa more below.
Parameters pressed_from_below() {
  Parameters p;
  p.boundaries = all(FlowBoundary::no_slip);
  p.boundaries.kind[2] = p.boundaries.kind[3] = FlowBoundary::free_slip;
  p.boundaries.kind[4] = p.boundaries.kind[5] = FlowBoundary::open;
  p.boundaries.pressure[4] = 5;
  return p;
}

TEST(AirFlow, AGuessFromTwoStepsSparesIterationsAndNotAccuracy) {
  // A bed that falls faster and faster through still air.
  const Grid grid{.count = {12, 4, 24}, .low = {}, .spacing = {2e-3, 2e-3, 2e-3}};
  Case lead(grid, Parameters{}), last(grid, Parameters{});
  int iterations_of_lead = 0, iterations_of_last = 0;
  for (int n = 0; n < 20; ++n)
    for (Case* c : {&lead, &last}) {
      c->set_solids(8, 16, 0.5, {0, 0, -1e-3 * n * n});
      if (n == 0) c->flow.begin(c->team, c->solids, c->state);
      if (c == &last) c->state.pressure_before = c->state.pressure;  // the guess is the last pressure
      c->flow.advance(c->team, 1e-4, c->solids, c->state, c->impulse);
      if (n >= 5) (c == &lead ? iterations_of_lead : iterations_of_last) += c->flow.iterations();
    }
  EXPECT_LT(iterations_of_lead, 0.9 * iterations_of_last);
  const double swing = *std::max_element(last.state.pressure.begin(), last.state.pressure.end());
  for_each_cell(grid, [&](int, int, int, std::size_t c) {
    EXPECT_NEAR(lead.state.pressure[c], last.state.pressure[c], 1e-4 * swing);
  });
}

TEST(AirFlow, APlateHoldsTheAirUntilItsGateOpens) {
  const Parameters p = pressed_from_below();
  const double h = 1e-3;
  Wall plate("plate", {0, 0, 8 * h}, {10 * h, 0, 8 * h}, {{3 * h, 7 * h, true}});
  Case c({.count = {10, 2, 16}, .low = {}, .spacing = {h, h, h}}, p, {plate});
  c.begin();
  c.advance(20e-6, 5);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(c.state.velocity[2][c.grid.index(i, 0, 8)], 0);
  // Shut, each side has the pressure of its opening.
  EXPECT_NEAR(c.state.pressure[c.grid.index(5, 0, 7)], 5, 1e-3);
  EXPECT_NEAR(c.state.pressure[c.grid.index(5, 0, 8)], 0, 1e-3);
  plate.open_gates(0);
  c.flow.set_walls({plate});
  c.advance(20e-6, 5);
  for (int i = 0; i < 10; ++i) {
    const double u = c.state.velocity[2][c.grid.index(i, 1, 8)];
    if (i >= 3 && i < 7)
      EXPECT_GT(u, 0.01);
    else
      EXPECT_EQ(u, 0);
  }
}

/// A wall from face to face, at an angle, with a gate in its middle.
TEST(AirFlow, AWallAtAnAngleHoldsTheAirUntilItsGateOpens) {
  Parameters p = pressed_from_below();
  p.tolerance = 1e-12;
  const double h = 1e-3;
  const double length = h * std::hypot(10, 7);
  Wall slope("slope", {0, 0, 4 * h}, {10 * h, 0, 11 * h}, {{0.3 * length, 0.7 * length, true}});
  Case c({.count = {10, 2, 16}, .low = {}, .spacing = {h, h, h}}, p);
  c.flow.set_walls({slope});
  c.begin();
  c.advance(20e-6, 5);
  const auto flow_through_floor = [&] {
    double sum = 0;
    for (int i = 0; i < 10; ++i) sum += c.state.velocity[2][c.grid.index(i, 0, 0)];
    return sum;
  };
  EXPECT_NEAR(flow_through_floor(), 0, 1e-9);
  for_each_cell(c.grid, [&](int i, int j, int k, std::size_t n) {
    EXPECT_NEAR(c.state.pressure[n], slope.above(c.grid.centre(i, j, k)) < 0 ? 5 : 0, 1e-3);
  });
  slope.open_gates(0);
  c.flow.set_walls({slope});
  c.advance(20e-6, 5);
  EXPECT_GT(flow_through_floor(), 0.05);
}

TEST(AirFlow, RefusesAVoidFractionOutOfRange) {
  Parameters p;
  p.boundaries = all(FlowBoundary::no_slip);
  Case c({.count = {4, 4, 4}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
  c.solids.fraction[c.grid.index(1, 2, 3)] = 1.01;
  try {
    c.begin();
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.report().place, testing::HasSubstr("(1, 2, 3)"));
  }
}

TEST(AirFlow, FrozenAirOnlyDrags) {
  Parameters p;
  p.boundaries = all(FlowBoundary::no_slip);
  p.motion = Motion::frozen;
  Case c({.count = {4, 4, 4}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
  c.set_solids(1, 3, 0.2, {0, 0, -1});
  c.begin();
  c.advance(1e-5);
  const double beta = coupling::drag_coefficient(p.drag, p.medium(), 0.2, 1);
  EXPECT_NEAR(c.impulse[2][c.grid.index(2, 2, 2)], 1e-5 * beta / 0.2, 1e-9 * beta);
  EXPECT_EQ(c.impulse[2][c.grid.index(2, 2, 3)], 0);
  EXPECT_EQ(c.state.velocity[2][c.grid.index(2, 2, 2)], 0);
}

/// Air in the pores of a bed, closed but for its top, where the pressure falls by a fifth: it expands by ln(10/8) of
/// its volume, and what continuity lacks is nothing. An incompressible one would not stir.
TEST(AirFlow, IsothermalAirExpandsUntilItsPressureIsThatOutside) {
  for (const Compressibility compressibility : {Compressibility::isothermal, Compressibility::none}) {
    Parameters p;
    p.pressure = 10;
    p.compressibility = compressibility;
    p.boundaries = all(FlowBoundary::free_slip);
    p.boundaries.kind[5] = FlowBoundary::open;
    p.boundaries.pressure[5] = -2;
    p.tolerance = 1e-9;
    const int n = 12;
    const double h = 1e-3, dt = 1e-3;
    Case c({.count = {2, 1, n}, .low = {}, .spacing = {h, h, h}}, p);
    c.set_solids(0, n, 0.6, {});
    c.begin();
    CellField excess = c.grid.cell_field();
    double left = 0;
    for (int step = 0; step < 1500; ++step) {
      c.advance(dt);
      c.flow.add_outflow(c.team, dt, c.state, excess);
      left += dt * 0.4 * c.state.velocity[2][c.grid.index(0, 0, n)];
    }
    const bool expands = compressibility == Compressibility::isothermal;
    for (int k = 0; k < n; ++k) {
      EXPECT_NEAR(c.state.pressure[c.grid.index(0, 0, k)], -2, 1e-3);
      EXPECT_NEAR(excess[c.grid.index(0, 0, k)], 0, 1e-4);
    }
    EXPECT_NEAR(left / (0.4 * n * h), expands ? std::log(10 / 8.0) : 0, 5e-3);
  }
}

/// Grains that change places with air: what continuity lacks is the volume that they moved, if the air is alone.
TEST(AirFlow, OutflowBalancesTheGrainsUnlessTheAirIsAlone) {
  for (const Continuity continuity : {Continuity::mixture, Continuity::air_alone}) {
    Parameters p;
    p.boundaries = all(FlowBoundary::no_slip);
    p.continuity = continuity;
    p.tolerance = 1e-10;
    Case c({.count = {8, 4, 12}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
    for_each_cell(c.grid, [&](int i, int, int k, std::size_t n) {
      if (i >= 4 || k < 2 || k >= 10) return;
      c.solids.fraction[n] = 0.4;
      c.solids.flux[2][n] = 0.4 * -0.5;
    });
    c.begin();
    const double dt = 50e-6;
    c.advance(dt);
    CellField excess = c.grid.cell_field();
    c.flow.add_outflow(c.team, dt, c.state, excess);
    // Of the face between the last layer of grains and the empty one below it: half of 0.4 falls through it.
    const double moved = dt * 0.2 * 0.5 / 1e-3, below = excess[c.grid.index(1, 1, 1)];
    EXPECT_NEAR(below, continuity == Continuity::mixture ? moved : 0, 1e-5 * moved);
  }
}

TEST(AirFlow, TimeStepFollowsItsThreeLimits) {
  Parameters p;
  p.boundaries = all(FlowBoundary::periodic);
  p.max_step = 1;
  p.courant = 0.5;
  Case c({.count = {4, 4, 4}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
  c.begin();
  EXPECT_EQ(c.flow.time_step(c.team, c.solids, c.state), 1);
  c.set_velocity([](const Vector3&) { return Vector3{2, 0, -3}; });
  EXPECT_NEAR(c.flow.time_step(c.team, c.solids, c.state), 0.5 / 5000, 1e-12);
  c.set_velocity([](const Vector3&) { return Vector3{}; });
  c.set_solids(0, 4, 0.6, {});
  const double beta = coupling::drag_coefficient(p.drag, p.medium(), 0.6, 0);
  EXPECT_NEAR(c.flow.time_step(c.team, c.solids, c.state), 0.1 * 0.16 * 1500 / beta, 1e-9);
}

TEST(AirFlow, SaysWhatHoldsItsStepAndWhere) {
  Parameters p;
  p.boundaries = all(FlowBoundary::periodic);
  Case c({.count = {4, 4, 4}, .low = {}, .spacing = {1e-3, 1e-3, 1e-3}}, p);
  c.begin();
  c.state.velocity[0][c.grid.index(2, 1, 3)] = 20;
  c.flow.time_step(c.team, c.solids, c.state);
  const NumericalError::Report moved = c.flow.step_limit(c.solids, c.state);
  EXPECT_THAT(moved.term, testing::HasSubstr("Courant number of the air"));
  EXPECT_THAT(moved.place, testing::HasSubstr("cell (1, 1, 3)"));  // the first of the two beside the face
  c.set_solids(0, 4, 0.6, {});
  c.solids.fraction[c.grid.index(3, 0, 2)] = 0.96;
  c.flow.time_step(c.team, c.solids, c.state);
  const NumericalError::Report after_drag = c.flow.step_limit(c.solids, c.state);
  EXPECT_THAT(after_drag.term, testing::HasSubstr("drag on the grains"));
  EXPECT_THAT(after_drag.place, testing::HasSubstr("cell (3, 0, 2)"));
  EXPECT_THAT(after_drag.place, testing::HasSubstr("solid fraction 0.96"));
}

}  // namespace
}  // namespace talus::air
