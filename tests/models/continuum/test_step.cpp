// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "models/continuum/cases.hpp"

namespace talus::continuum {
namespace {

using std::numbers::pi;

/// Sets velocities of a new model by place.
template <class Field>
Continuum started(const Parameters& p, ThreadTeam& team, Field&& field) {
  Continuum model(p);
  State& s = model.mutable_state();
  for (std::size_t i = 0; i < s.position.size(); ++i) s.velocity[i] = field(s.position[i]);
  model.begin(team);
  return model;
}

const std::vector<Method> methods = {Method::runge_kutta, Method::leapfrog};

TEST(Advance, InFreeFallABlockKeepsItsShapeAndFallsAsItMust) {
  for (const Method method : methods) {
    Parameters p = free_block(4, 3, 5);
    p.integration.method = method;
    ThreadTeam team(1);
    Continuum model = started(p, team);
    const State& s = model.state();
    const auto start = by_identity(s, s.position);
    const double mass = s.mass;
    while (s.time < 0.02) model.advance(team);
    const auto end = by_identity(s, s.position);
    for (std::size_t i = 0; i < start.size(); ++i) {
      EXPECT_NEAR(end[i].x, start[i].x, 1e-14);
      EXPECT_NEAR(start[i].z - end[i].z, 0.5 * 9.81 * s.time * s.time, 1e-12);
      EXPECT_NEAR(s.density[i], 1500, 1e-9);
    }
    EXPECT_NEAR(norm(momentum_error(s)), 0, 1e-13 * mass * double(start.size()));
  }
}

/// Mean vertical stress of each layer of a column and the one above it, from the floor on. The mean of two, because
/// stresses that alternate from layer to layer hardly push particles on a lattice, and so a few per cent of that
/// remain.
std::vector<double> stress_between_layers(const State& s, int layers) {
  std::vector<double> sum(static_cast<std::size_t>(layers)), count(sum.size());
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const auto layer = std::min(sum.size() - 1, static_cast<std::size_t>(s.position[i].z / spacing));
    sum[layer] += s.material.stress[2][i], ++count[layer];
  }
  std::vector<double> between;
  for (std::size_t k = 0; k + 1 < sum.size(); ++k)
    between.push_back(0.5 * (sum[k] / count[k] + sum[k + 1] / count[k + 1]));
  return between;
}

TEST(Advance, ABedSettlesOnItsFloorWhichThenCarriesItsWeight) {
  for (const Method method : methods) {
    Parameters p = column(4, 1, 20, 10);
    p.gate.opens = GateOpens::when_settled;
    p.settle.damping_time = 5e-3;
    p.settle.duration = 5e-3;
    p.settle.speed = 1e-6;
    p.sph.viscosity_alpha = 0.1;
    p.integration.method = method;
    ThreadTeam team(2);
    Continuum model = started(p, team);
    while (model.state().gate_time < 0) model.advance(team);
    const State& s = model.state();
    const double weight = s.mass * 80 * 9.81;
    const double before = s.patch_impulse[4].z, begin = s.time;
    double sideways = 0;
    while (s.time < begin + 2e-3) {
      model.advance(team);
      for (const Vector3& v : s.velocity) sideways = std::max(sideways, std::hypot(v.x, v.y));
    }
    EXPECT_NEAR(-(s.patch_impulse[4].z - before) / (s.time - begin), weight, 0.001 * weight);
    EXPECT_LT(sideways, 1e-12);
    const std::vector<double> stress = stress_between_layers(s, 20);
    for (int k = 1; k < 17; ++k) {
      const double weight_above = 1500 * 9.81 * (19 - k) * spacing / lattice_moment();
      EXPECT_NEAR(stress[static_cast<std::size_t>(k)], weight_above, 0.01 * weight_above);
    }
    EXPECT_LT(norm(momentum_error(s)), 1e-12 * norm(s.gravity_impulse));
  }
}

/// Horizontal over vertical stress of a settled bed of friction 0.28 between smooth walls.
double settled_stress_ratio(double damping_time, std::optional<double> loading_time,
                            Filling filling = Filling::at_once) {
  Parameters p = column(3, 1, 20, 10);
  make_granular(p);
  p.law = granular::DruckerPrager::Parameters{.friction = 0.28};
  p.walls.friction = Friction::none;
  p.gate.opens = GateOpens::when_settled;
  p.settle.loading_time = loading_time;
  p.settle.filling = filling;
  p.settle.damping_time = damping_time;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  while (model.state().gate_time < 0) model.advance(team);
  EXPECT_LT(norm(momentum_error(model.state())), 1e-9 * norm(model.state().gravity_impulse));
  const auto& stress = model.state().material.stress;
  return std::accumulate(stress[0].begin(), stress[0].end(), 0.0) /
         std::accumulate(stress[2].begin(), stress[2].end(), 0.0);
}

TEST(Advance, ABedThatTakesUpItsWeightSlowlyIsNotOverconsolidated) {
  // At yield in uniaxial strain, |s| = sqrt(2) mu p: K = (1 - mu/sqrt(3))/(1 + 2 mu/sqrt(3)).
  const double m = 0.28 / std::sqrt(3.0), exact = (1 - m) / (1 + 2 * m);
  EXPECT_GT(settled_stress_ratio(20e-3, 0.0), 1.2 * exact) << "pressed by a wave, and unloaded elastically";
  for (const double damping_time : {20e-3, 2e-3})
    EXPECT_NEAR(settled_stress_ratio(damping_time, std::nullopt), exact, 0.03 * exact) << damping_time;
  EXPECT_NEAR(settled_stress_ratio(2e-3, std::nullopt, Filling::layers), exact, 0.03 * exact) << "in layers";
}

TEST(Advance, ABedBeginsWithItsVelocity) {
  for (const Method method : methods) {
    Parameters p = free_block(3, 2, 3);
    p.integration.method = method;
    p.bed.velocity = {0.3, 0, 0.5};
    ThreadTeam team(1);
    Continuum model = started(p, team);
    const State& s = model.state();
    const auto start = by_identity(s, s.position);
    while (s.time < 0.02) model.advance(team);
    const auto end = by_identity(s, s.position);
    for (std::size_t i = 0; i < start.size(); ++i) {
      EXPECT_NEAR(end[i].x - start[i].x, 0.3 * s.time, 1e-12);
      EXPECT_NEAR(end[i].z - start[i].z, 0.5 * s.time - 0.5 * 9.81 * s.time * s.time, 1e-12);
    }
  }
}

TEST(Advance, ThePrintedStressFormRaisesTheStressByTheInverseOfThePacking) {
  Parameters p = column(3, 1, 16, 10);
  p.gate.opens = GateOpens::when_settled;
  p.settle.damping_time = 5e-3;
  p.settle.duration = 2e-3;
  p.settle.speed = 1e-6;
  p.sph.viscosity_alpha = 0.1;
  p.sph.stress_form = sph::StressForm::printed;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  while (model.state().gate_time < 0) model.advance(team);
  const State& s = model.state();
  const std::vector<double> stress = stress_between_layers(s, 16);
  for (int k = 1; k < 12; ++k) {
    const double weight_above = 1500 * 9.81 * (15 - k) * spacing / lattice_moment();
    EXPECT_NEAR(stress[static_cast<std::size_t>(k)], weight_above / 0.6, 0.02 * weight_above);
  }
}

/// Period of a small standing pressure wave between floor and top of a closed column, from the zeros of its amplitude.
double wave_period(const Parameters& p, int particles, int periods) {
  ThreadTeam team(1);
  const double length = particles * spacing;
  const auto mode = [&](const Vector3& x) { return std::sin(pi * x.z / length); };
  Continuum model = started(p, team, [&](const Vector3& x) { return Vector3{0, 0, 1e-3 * mode(x)}; });
  std::vector<double> zeros;
  double before = 1;
  while (zeros.size() < 2 * static_cast<std::size_t>(periods) + 1) {
    model.advance(team);
    const State& s = model.state();
    double amplitude = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i) amplitude += s.velocity[i].z * mode(s.position[i]);
    if ((amplitude > 0) != (before > 0)) zeros.push_back(s.time - s.last_step * amplitude / (amplitude - before));
    before = amplitude;
  }
  return (zeros.back() - zeros.front()) / periods;
}

TEST(Advance, PressureWavesTravelWithTheirSpeed) {
  // c^2 = (lambda + 2 G)/rho times the moment of the kernel's gradient on the lattice, once, for the divergence of the
  // stress; a wave of 80 spacings loses less than 0.1 % to the lattice's dispersion.
  for (const Method method : methods) {
    Parameters p = column(2, 1, 40);
    p.box.top = FaceKind::wall;
    p.gravity.acceleration = 0;
    p.integration.method = method;
    const double c = std::sqrt(2e6 / 1500 * lattice_moment());
    EXPECT_NEAR(wave_period(p, 40, 2), 2 * 40 * spacing / c, 0.003 * 2 * 40 * spacing / c);
  }
}

TEST(Advance, HalvingTheStepQuartersTheError) {
  for (const Method method : methods) {
    Parameters p = column(2, 1, 10);
    p.box.top = FaceKind::wall;
    p.gravity.acceleration = 0;
    p.integration.method = method;
    const double end = 1.6e-3;
    const auto after = [&](double step) {
      ThreadTeam team(1);
      p.integration.step = step;
      Continuum model = started(p, team, [&](const Vector3& x) {
        return Vector3{0, 0, 0.1 * std::sin(pi * x.z / (10 * spacing))};
      });
      while (model.state().time < end - 0.5 * step) model.advance(team);
      return by_identity(model.state(), model.state().material.stress[2]);
    };
    const auto distance = [](const std::vector<double>& a, const std::vector<double>& b) {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
      return std::sqrt(sum);
    };
    const auto reference = after(end / 1024);
    const double coarse = distance(after(end / 32), reference), fine = distance(after(end / 64), reference);
    EXPECT_GT(coarse / fine, 3.5) << choice_name(method);
    EXPECT_LT(coarse / fine, 4.5) << choice_name(method);
  }
}

TEST(Advance, ASpinningBlockKeepsItsAngularMomentumAndCarriesItsStressAlong) {
  Parameters p = free_block(12, 3, 12);
  p.gravity.acceleration = 0;
  p.sph.viscosity_alpha = 0.05;
  // Slow enough that the centrifugal stress, rho (omega R)^2, strains it by less than 1e-3.
  const double omega = 8;
  ThreadTeam team(2);
  const Vector3 centre{0.5, 1.5 * spacing, 5 + 6 * spacing};
  Continuum model = started(p, team, [&](const Vector3& x) {
    return Vector3{omega * (x.z - centre.z), 0, -omega * (x.x - centre.x)};
  });
  const State& s = model.state();
  const auto start = by_identity(s, s.position);
  const auto spin = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      const Vector3 r = s.position[i] - centre;
      sum += r.z * s.velocity[i].x - r.x * s.velocity[i].z;
    }
    return sum;
  };
  const double before = spin();
  while (omega * s.time < pi / 2) model.advance(team);
  EXPECT_NEAR(spin() / before, 1, 1e-3);
  const double angle = omega * s.time;
  const auto end = by_identity(s, s.position);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Vector3 r0 = start[i] - centre;
    const Vector3 r = end[i] - centre;
    EXPECT_NEAR(r.x, std::cos(angle) * r0.x + std::sin(angle) * r0.z, 0.05 * spacing);
    EXPECT_NEAR(r.z, -std::sin(angle) * r0.x + std::cos(angle) * r0.z, 0.05 * spacing);
  }
}

/// A small hopper with its gate open, over which particles hit everything there is: walls, friction, plate, slit,
/// floor.
TEST(Advance, MomentumIsWhatGravityAndTheWallsGave) {
  for (const Method method : methods) {
    Parameters p = small_hopper();
    p.integration.method = method;
    ThreadTeam team(2);
    Continuum model = started(p, team);
    while (model.state().time < 0.2) model.advance(team);
    const State& s = model.state();
    EXPECT_LT(norm(momentum_error(s)), 1e-11 * norm(s.gravity_impulse));
    std::size_t below = 0;
    for (const Vector3& x : s.position) below += x.z < *p.plate.height;
    EXPECT_GT(below, 10u);                         // through the slit
    EXPECT_LT(below, s.position.size() - 40);      // and not through the plate
    EXPECT_GT(std::abs(s.patch_impulse[6].x), 0);  // friction at the plate
    for (const Vector3& x : s.position) {
      EXPECT_GE(x.z, 0);
      EXPECT_TRUE(x.x >= 0 && x.x <= p.box.width);
    }
  }
}

TEST(Advance, LeftAndRightStayMirrorImages) {
  Parameters p = small_hopper();
  p.plate.slit_left = 3.5 * spacing;
  p.plate.slit_right = 8.5 * spacing;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  while (model.state().time < 0.05) model.advance(team);
  const State& s = model.state();
  const auto place = by_identity(s, s.position);
  for (std::size_t n = 0; n < place.size(); ++n) {
    const Vector3& partner = place[n / 12 * 12 + (11 - n % 12)];
    EXPECT_NEAR(place[n].x + partner.x, p.box.width, 1e-6 * spacing);
    EXPECT_NEAR(place[n].z, partner.z, 1e-6 * spacing);
  }
}

TEST(Advance, AOneLayerSectionStaysInItsPlane) {
  Parameters p = small_hopper();
  p.box.depth = spacing;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  while (model.state().time < 0.1) model.advance(team);
  for (const Vector3& x : model.state().position) EXPECT_NEAR(x.y, 0.5 * spacing, 1e-9 * spacing);
}

TEST(Advance, SameBitsForAnyNumberOfThreads) {
  for (const Method method : methods) {
    Parameters p = small_hopper();
    p.integration.method = method;
    ThreadTeam one(1), three(3);
    Continuum a = started(p, one), b = started(p, three);
    for (int n = 0; n < 300; ++n) a.advance(one), b.advance(three);
    EXPECT_EQ(a.state().position, b.state().position);
    EXPECT_EQ(a.state().velocity, b.state().velocity);
    EXPECT_EQ(a.state().material.stress, b.state().material.stress);
    EXPECT_EQ(a.state().patch_impulse, b.state().patch_impulse);
  }
}

/// What a checkpoint leaves of a state: derived columns are gone.
struct ForgetDerived {
  void operator()(const FieldInfo& field, auto& member) const {
    if (field.role == FieldRole::derived) member = {};
  }
};

TEST(Advance, AResumedRunTakesTheSameSteps) {
  for (const Method method : methods) {
    Parameters p = small_hopper();
    p.integration.method = method;
    p.gate.opens = GateOpens::at_time;
    p.gate.time = 0.01;
    p.settle.viscosity_alpha = 0.2;
    ThreadTeam team(2);
    Continuum opening = started(p, team);
    int opens = 0;
    for (; opening.state().gate_time < 0; ++opens) opening.advance(team);
    // Before, at and after the opening of the gate, between list builds and beside sorts.
    for (const int stop : {1, 90, opens - 1, opens, opens + 1, 731}) {
      Continuum whole = started(p, team);
      for (int n = 0; n < stop; ++n) whole.advance(team);
      Continuum resumed(p);
      resumed.mutable_state() = whole.state();
      for_each_field(ForgetDerived{}, resumed.mutable_state());
      resumed.resume(team);
      EXPECT_EQ(resumed.state().packing, whole.state().packing);
      EXPECT_EQ(resumed.state().strain, whole.state().strain);
      EXPECT_EQ(resumed.state().shear_rate, whole.state().shear_rate);
      for (int n = 0; n < 200; ++n) whole.advance(team), resumed.advance(team);
      EXPECT_EQ(whole.state().position, resumed.state().position);
      EXPECT_EQ(whole.state().velocity, resumed.state().velocity);
      EXPECT_EQ(whole.state().list_builds, resumed.state().list_builds);
      EXPECT_EQ(whole.state().patch_impulse, resumed.state().patch_impulse);
    }
  }
}

TEST(Advance, StopsAtTheFirstImpossibleValueAndNamesIt) {
  Parameters p = column(3, 1, 6, 10);
  p.integration.step = 1e-3;  // many times the stable one
  ThreadTeam team(1);
  Continuum model = started(p, team);
  try {
    for (int n = 0; n < 10000; ++n) model.advance(team);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("particle"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("a smaller integration.step"), std::string::npos);
  }
}

TEST(Advance, ABedThatDoesNotSettleInTimeIsAnError) {
  Parameters p = column(3, 1, 6, 10);
  p.gate.opens = GateOpens::when_settled;
  p.settle.max_time = 0.01;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  EXPECT_THROW(while (model.state().time < 0.02) model.advance(team), NumericalError);
}

TEST(Totals, AreTheSameNamesEveryTimeAndOnlyWallsThatAreThere) {
  ThreadTeam team(1);
  Continuum model = started(small_hopper(), team);
  const auto names = [&] {
    std::vector<std::string> found;
    for (const NamedValue& value : model.totals()) found.push_back(value.name);
    return found;
  };
  const auto before = names();
  for (int n = 0; n < 3; ++n) model.advance(team);
  EXPECT_EQ(names(), before);
  EXPECT_NE(std::find(before.begin(), before.end(), "impulse_plate_z"), before.end());
  EXPECT_EQ(std::find(before.begin(), before.end(), "impulse_top_z"), before.end());
}

}  // namespace
}  // namespace talus::continuum
