// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/displacement.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "models/continuum/cases.hpp"

namespace talus::continuum {
namespace {

/// The paper's route, as far as the law goes.
granular::LawParameters printed_route() {
  return granular::YuuUmekagePrinted::Parameters{.fits = {.tables = granular::Tables::printed, .max_deviator = 1000},
                                                 .contact = {.volume = granular::Volume::strain},
                                                 .strain = granular::Strain::displacements,
                                                 .rule = {.reset = granular::Reset::strain, .smoothing_time = 0}};
}

std::vector<SymmetricTensor3<>> strain_of(const Parameters& p, std::vector<Vector3> places, double stretch) {
  ThreadTeam team(1);
  const std::vector<Vector3> reset = places;
  for (Vector3& x : places) x.z *= 1 + stretch;
  const std::vector<double> h(places.size(), p.bed.spacing);
  const Domain domain = Boundary(p).domain();
  Neighbourhood around(domain);
  around.build(team, places, h, 0);
  std::vector<SymmetricTensor3<>> strain;
  measure_strain(team, around, places, reset, h, strain);
  return strain;
}

TEST(MeasureStrain, IsExactInAStretchedBedFromItsFloorToItsSurface) {
  const Parameters p = column(3, 2, 5, 3);
  for (const double stretch : {-0.02, 0.03}) {
    const auto strain = strain_of(p, Continuum(p).state().position, stretch);
    ASSERT_EQ(strain.size(), 30u);
    for (const SymmetricTensor3<>& e : strain) {
      EXPECT_NEAR(e.zz, (1 / ((1 + stretch) * (1 + stretch)) - 1) / 2, 1e-14);
      for (const double other : {e.xx, e.yy, e.xy, e.yz, e.zx}) EXPECT_NEAR(other, 0, 1e-14);
    }
  }
}

TEST(MeasureStrain, ThePlatesTwoSidesDoNotCount) {
  Parameters p = column(3, 1, 16, 0);
  p.plate.height = 8 * spacing;
  p.bed.bottom = 0;
  p.box.front = p.box.rear = FaceKind::printed;
  const auto position = Continuum(p).state().position;
  ASSERT_EQ(position.size(), 48u);
  const std::vector<double> h(position.size(), spacing);
  ThreadTeam team(1);
  const Domain domain = Boundary(p).domain();
  Neighbourhood around(domain);
  around.build(team, position, h, 0);
  // Only what is below the plate has moved, as a whole and along it.
  std::vector<Vector3> reset = position;
  for (Vector3& X : reset)
    if (X.z < *p.plate.height) X.y -= 0.3 * spacing;
  std::vector<SymmetricTensor3<>> strain;
  measure_strain(team, around, position, reset, h, strain);
  for (const SymmetricTensor3<>& e : strain) EXPECT_NEAR(norm(e), 0, 1e-14);
}

TEST(PrintedRoute, FreeFallStrainsNothingAndKeepsItsReference) {
  Parameters p = free_block(3, 2, 3);
  p.law = printed_route();
  ThreadTeam team(1);
  Continuum model = started(p, team);
  const std::vector<Vector3> start = by_identity(model.state(), model.state().reset_position);
  for (int n = 0; n < 50; ++n) model.advance(team);
  EXPECT_LT(by_identity(model.state(), model.state().position)[0].z, start[0].z);
  EXPECT_EQ(by_identity(model.state(), model.state().reset_position), start);
  for (const double e : model.state().strain) EXPECT_LT(e, 1e-12);
}

TEST(PrintedRoute, AResetStartsTheDisplacementAnew) {
  for (const Method method : {Method::runge_kutta, Method::leapfrog}) {
    Parameters p = column(2, 1, 6, 30);
    p.law = printed_route();
    p.integration.method = method;
    p.sph.viscosity_alpha = 0.5;
    ThreadTeam team(1);
    Continuum model = started(p, team);
    const auto resets = [&] {
      for (std::size_t k = 0; k < model.state().slots.size(); ++k)
        if (model.state().slots[k].name == std::string("resets"))
          return by_identity(model.state(), model.state().material.history[k]);
      return std::vector<double>{};
    };
    // A bed thrown upwards: stress is lost and the strain starts from zero.
    for (int n = 0; n < 40; ++n) model.advance(team);
    for (Vector3& v : model.mutable_state().velocity) v.z += 0.1 * (v.z < 0 ? 1 : 2);
    int seen = 0;
    for (int n = 0; n < 400; ++n) {
      const std::vector<double> before = resets();
      const std::vector<Vector3> reference = by_identity(model.state(), model.state().reset_position);
      model.advance(team);
      const std::vector<double> after = resets();
      const std::vector<Vector3> now = by_identity(model.state(), model.state().reset_position),
                                 place = by_identity(model.state(), model.state().position);
      for (std::size_t i = 0; i < after.size(); ++i) {
        seen += after[i] != before[i];
        EXPECT_EQ(now[i], after[i] != before[i] ? place[i] : reference[i]);
      }
    }
    EXPECT_GT(seen, 0);
  }
}

TEST(PrintedRoute, AResumedRunTakesTheSameStepsOnAnyNumberOfThreads) {
  Parameters p = small_hopper();
  p.law = printed_route();
  p.sph.viscosity_alpha = 0.5;
  ThreadTeam one(1), two(2);
  Continuum whole = started(p, one);
  for (int n = 0; n < 150; ++n) whole.advance(one);
  Continuum resumed(p);
  resumed.mutable_state() = whole.state();
  resumed.resume(two);
  for (int n = 0; n < 100; ++n) whole.advance(one), resumed.advance(two);
  EXPECT_EQ(whole.state().position, resumed.state().position);
  EXPECT_EQ(whole.state().reset_position, resumed.state().reset_position);
  EXPECT_EQ(whole.state().material.stress, resumed.state().material.stress);
}

TEST(Advance, StopsAtAParticleThatIsThrownOrThinsOut) {
  ThreadTeam team(1);
  for (const bool thrown : {true, false}) {
    Parameters p = small_hopper();
    if (!thrown) p.plate.height = 6 * spacing;  // the floor's mirrors are out of reach of a kernel three times as wide
    Continuum model = started(p, team);
    if (thrown)
      model.mutable_state().material.stress[2][7] = 1e15;  // by far more than the law gives
    else
      model.mutable_state().density[7] *= 1e-6;
    try {
      for (int n = 0; n < 3; ++n) model.advance(team);
      FAIL() << "no error";
    } catch (const NumericalError& error) {
      EXPECT_NE(std::string(error.what()).find(thrown ? "a spacing a step" : "bulk density"), std::string::npos)
          << error.what();
    }
  }
}

TEST(Advance, GoesOnWhereAParticleIsFasterThanWaves) {
  ThreadTeam team(1);
  Parameters p = small_hopper();
  p.box.right = FaceKind::open;
  p.air.enabled = false;
  Continuum model = started(p, team);
  const double begin = model.state().last_step;
  const State& s = model.state();
  model.mutable_state().velocity[0].x = 100;
  model.advance(team);
  EXPECT_LE(100 * s.last_step, 0.25 * spacing * (1 + 1e-12)) << "within the box it shortens the step";
  EXPECT_GT(100 * s.last_step, 0.2 * spacing);
  model.mutable_state().velocity[0] = {1e4, 0, 0};
  model.mutable_state().position[0].x = 3 * p.box.width;
  for (int n = 0; n < 3; ++n) model.advance(team);
  EXPECT_GT(s.last_step, 0.5 * begin) << "what has left meets nobody";
  EXPECT_GT(s.position[0].x, 3.1 * p.box.width);
}

}  // namespace
}  // namespace talus::continuum
