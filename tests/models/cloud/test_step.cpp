// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases.hpp"
#include "physics/hydrodynamics/stokes.hpp"

namespace talus::cloud {
namespace {

Grains two_grains(const Parameters& p, double distance_over_radius) {
  const double a = p.particles.radius;
  return {{{0, 0, 0}, {0, distance_over_radius * a, 0}}, {a, a}};
}

TEST(Scales, DoNotDependOnHowGravityIsWritten) {
  Parameters p = disc(1);
  p.slope.enabled = true;
  p.slope.angle = std::numbers::pi / 6;
  Parameters q = p;
  q.slope.angle = 0;
  q.gravity.direction = {1, 0, -std::sqrt(3)};
  for (const Motion motion : {Motion::xy, Motion::xz, Motion::xyz}) {
    p.motion = q.motion = motion;
    EXPECT_NEAR(scales(p).driving, 0.5, 1e-15);
    EXPECT_NEAR(scales(q).driving, 0.5, 1e-15);
  }
}

TEST(Velocities, AloneAGrainFallsWithTheStokesSpeed) {
  Parameters p = disc(1);
  ThreadTeam team(1);
  Cloud cloud(p, {{{0, 0, 0}}, {p.particles.radius}});
  cloud.begin(team);
  // Eq. 5b.
  const double v_s = 2.0 / 9.0 * 9.81 * (20 - 1.2) * std::sin(p.slope.angle) / 1.82e-5 * 25e-6;
  EXPECT_NEAR(scales(p).stokes_speed, v_s, 1e-12 * v_s);
  EXPECT_NEAR(cloud.state().velocity[0].x, v_s, 1e-12 * v_s);
  EXPECT_EQ(cloud.state().velocity[0].y, 0);
}

TEST(Scales, ReproduceThePapersContactRatios) {
  // Eq. 9: 130, 20 and 5 for 1, 2.5 and 5 mm.
  for (const auto& [radius, printed] : {std::pair{1e-3, 129.4}, {2.5e-3, 20.7}, {5e-3, 5.18}}) {
    Parameters p = disc(10);
    p.particles.radius = radius;
    EXPECT_NEAR(scales(p).contact_ratio, printed, 0.005 * printed);
  }
}

TEST(Velocities, RepulsionPushesApart) {
  for (const auto mobility :
       {hydrodynamics::Mobility::rotne_prager_1969, hydrodynamics::Mobility::zuk_2014, hydrodynamics::Mobility::none}) {
    Parameters p = disc(2);
    p.fluid.mobility = mobility;
    ThreadTeam team(1);
    Cloud cloud(p, two_grains(p, 1.9));
    cloud.begin(team);
    const State& s = cloud.state();
    EXPECT_LT(s.velocity[0].y, 0);
    EXPECT_GT(s.velocity[1].y, 0);
    EXPECT_NEAR(s.overlap[0], 0.1 * p.particles.radius, 1e-15);
    EXPECT_NEAR(s.contact_force[1].y, 10 * 0.1 * p.particles.radius, 1e-14);
  }
}

TEST(Advance, WithoutDragThePatternIsKept) {
  Parameters p = disc(200);
  p.fluid.mobility = hydrodynamics::Mobility::none;
  p.particles.radius_spread = 0;
  ThreadTeam team(1);
  Cloud cloud = started(p, team);
  const auto start = cloud.state().position;
  run_until(cloud, team, 5 * scales(p).stokes_time);
  const double expected = scales(p).stokes_speed * cloud.state().time;
  for (std::size_t i = 0; i < start.size(); ++i) {
    EXPECT_NEAR(cloud.state().position[i].x - start[i].x, expected, 1e-9 * expected);
    EXPECT_NEAR(cloud.state().position[i].y, start[i].y, 1e-12);
  }
}

/// A cloud falls and is brought back by reversed gravity. \returns by how much the grains miss their places, in radii
double missed_on_return(Parameters p, Method method, double max_step) {
  p.integration.method = method;
  p.integration.max_step = max_step;
  ThreadTeam team(1);
  const Grains start = pack(p);
  Grains grains = start;
  double end = 2 * scales(p).stokes_time;
  for (const double upwards : {-1.0, 1.0}) {
    p.gravity.direction = {0, 0, upwards};
    Cloud cloud(p, grains);
    cloud.begin(team);
    run_until(cloud, team, end * (1 - 1e-9));
    end = cloud.state().time;
    if (upwards < 0) {
      const double fallen = start.position[0].z - cloud.state().position[0].z;
      EXPECT_GT(fallen, 4 * p.particles.radius) << "something has moved";
    }
    grains.position = cloud.state().position;
  }
  double worst = 0;
  for (std::size_t i = 0; i < start.position.size(); ++i)
    worst = std::max(worst, norm(grains.position[i] - start.position[i]));
  return worst / p.particles.radius;
}

Parameters cloud_without_contacts(std::int64_t count) {
  Parameters p = polystyrene(Shape::ball, count);
  p.particles.size = 12 * p.particles.radius;
  p.motion = Motion::xyz;
  p.slope.enabled = p.contact.enabled = false;
  p.fluid.mobility = hydrodynamics::Mobility::zuk_2014;
  p.integration.tolerance = 1e3;
  return p;
}

// Stokes flow is reversible; what remains is the steps' error.
TEST(Advance, WithoutContactsReversedGravityTakesACloudBack) {
  const Parameters p = cloud_without_contacts(60);
  const double coarse = missed_on_return(p, Method::chebyshev, 0.02);
  const double fine = missed_on_return(p, Method::chebyshev, 0.01);
  EXPECT_LT(fine, 0.2);
  EXPECT_NEAR(coarse / fine, 2, 0.3) << "of first order";
}

TEST(Advance, DormandPrinceTakesACloudBackToAMillionthOfARadius) {
  EXPECT_LT(missed_on_return(cloud_without_contacts(50), Method::dormand_prince, 0.01), 1e-6);
}

TEST(Advance, DormandPrinceIsOfFifthOrder) {
  // Three unequal grains at places that give them no symmetry.
  Parameters p = cloud_without_contacts(3);
  p.integration.method = Method::dormand_prince;
  p.gravity.direction = {0, 0, -1};
  const double a = p.particles.radius, end = 4 * scales(p).stokes_time;
  const Grains grains{{{0, 0, 0}, {2.5 * a, 0.2 * a, 0.3 * a}, {-0.4 * a, 2.6 * a, 0.9 * a}}, {a, 0.8 * a, 1.1 * a}};
  ThreadTeam team(1);
  const auto after = [&](int steps) {
    p.integration.max_step = 4.0 / steps;
    Cloud cloud(p, grains);
    cloud.begin(team);
    cloud.mutable_state().next_step = end;  // steps of equal length from the first
    run_until(cloud, team, end * (1 - 1e-9));
    EXPECT_EQ(cloud.state().step, static_cast<std::uint64_t>(steps));
    return cloud.state().position;
  };
  const auto exact = after(512);
  const auto error = [&](int steps) {
    const auto places = after(steps);
    double worst = 0;
    for (std::size_t i = 0; i < places.size(); ++i) worst = std::max(worst, norm(places[i] - exact[i]));
    return worst / a;
  };
  const double coarse = error(16), fine = error(32);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 5, 0.6);
}

TEST(Advance, DormandPrinceHoldsItsTolerance) {
  Parameters p = cloud_without_contacts(20);
  p.integration.method = Method::dormand_prince;
  p.integration.max_step = 10;
  p.gravity.direction = {0, 0, -1};
  ThreadTeam team(1);
  const Grains grains = pack(p);
  const auto steps = [&](double tolerance) {
    p.integration.tolerance = tolerance;
    Cloud cloud(p, grains);
    cloud.begin(team);
    run_until(cloud, team, 30 * scales(p).stokes_time);
    return static_cast<double>(cloud.state().step);
  };
  // The local error of the embedded solution goes as the fifth power of the step.
  EXPECT_NEAR(steps(1e-10) / steps(1e-8), std::pow(100, 0.2), 0.3);
}

TEST(Advance, ARestingGrainSinksIntoTheSlopeByItsWeightOverTheStiffness) {
  Parameters p = polystyrene(Shape::file, 1);
  p.motion = Motion::xz;
  ThreadTeam team(1);
  Cloud cloud(p, {{{0, 0, 0.9 * p.particles.radius}}, {p.particles.radius}});
  cloud.begin(team);
  run_until(cloud, team, 30 * scales(p).stokes_time);
  const double depth = scales(p).mean_weight * std::cos(p.slope.angle) / p.contact.stiffness;
  EXPECT_NEAR(p.particles.radius - cloud.state().position[0].z, depth, 1e-6 * depth);
}

TEST(Stiffness, PowerIterationFindsTheRateOfTwoTouchingGrains) {
  Parameters p = disc(2);
  p.fluid.mobility = hydrodynamics::Mobility::none;
  ThreadTeam team(1);
  Cloud cloud(p, two_grains(p, 1.9));
  cloud.begin(team);
  Workspace work(p, cloud.state());
  work.velocities.arrange_sum(cloud.state().spatial_order, cloud.state().sum_cutoff);
  estimate_stiffness(team, p, cloud.mutable_state(), work, 30);
  const double exact = 2 * p.contact.stiffness * hydrodynamics::stokes_mobility(p.particles.radius, p.fluid.viscosity);
  EXPECT_NEAR(cloud.state().spectral_radius, exact, 0.01 * exact);
}

TEST(Advance, ChebyshevAndEulerConvergeToTheSameMotion) {
  Parameters p = disc(60);
  ThreadTeam team(1);
  auto after = [&](Method method, double max_step) {
    p.integration.method = method;
    p.integration.max_step = max_step;
    p.integration.tolerance = 1e3;
    p.integration.overlap_growth = 1e3;
    Cloud cloud = started(p, team);
    const double end = 1.0 * scales(p).stokes_time;
    while (cloud.state().time < end) cloud.advance(team);
    // Back to exactly `end` along the last step.
    std::vector<Vector3> x = cloud.state().position;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] -= ((cloud.state().time - end) / cloud.state().last_step) * cloud.state().increment[i];
    return x;
  };
  auto distance = [&](const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i] - b[i], a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size())) / p.particles.radius;
  };
  const auto reference = after(Method::euler, 1e-4);
  EXPECT_LT(distance(after(Method::dormand_prince, 0.02), reference), 1e-3);
  const double coarse = distance(after(Method::chebyshev, 0.02), reference);
  const double fine = distance(after(Method::chebyshev, 0.005), reference);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.45 * coarse);
}

TEST(Advance, SameBitsForAnyNumberOfThreads) {
  Parameters p = disc(500);
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    p.fluid.precision = precision;
    ThreadTeam one(1), three(3);
    Cloud a = started(p, one), b = started(p, three);
    for (int n = 0; n < 20; ++n) a.advance(one), b.advance(three);
    EXPECT_EQ(a.state().position, b.state().position);
    EXPECT_EQ(a.state().time, b.state().time);
    EXPECT_EQ(a.state().spectral_radius, b.state().spectral_radius);
  }
}

/// What a checkpoint leaves of a state: derived columns are gone.
struct ForgetDerived {
  void operator()(const FieldInfo& field, auto& member) const {
    if (field.role == FieldRole::derived) member = {};
  }
};

TEST(Advance, AResumedRunTakesTheSameSteps) {
  const Parameters p = disc(400);
  ThreadTeam team(2);
  // Stops at steps that are and are not multiples of the sorting and estimating intervals.
  for (const int stop : {1, 16, 21, 30}) {
    Cloud whole = started(p, team);
    for (int n = 0; n < stop; ++n) whole.advance(team);
    Cloud resumed(p, {});
    resumed.mutable_state() = whole.state();
    for_each_field(ForgetDerived{}, resumed.mutable_state());
    resumed.resume(team);
    EXPECT_EQ(resumed.state().velocity, whole.state().velocity);
    for (int n = 0; n < 25; ++n) whole.advance(team), resumed.advance(team);
    EXPECT_EQ(whole.state().position, resumed.state().position);
    EXPECT_EQ(whole.state().time, resumed.state().time);
    EXPECT_EQ(whole.state().evaluations, resumed.state().evaluations);
  }
}

TEST(Advance, OverlapsStaySmallAndTheCloudGathersSpeed) {
  const Parameters p = disc(500);
  ThreadTeam team(2);
  Cloud cloud = started(p, team);
  double overlap = 0;
  while (cloud.state().time < 3 * scales(p).stokes_time) {
    cloud.advance(team);
    overlap = std::max(overlap, *std::max_element(cloud.state().overlap.begin(), cloud.state().overlap.end()));
  }
  EXPECT_LT(overlap, 0.1 * p.particles.radius);
  EXPECT_GT(overlap, 0);
  EXPECT_GT(cloud.totals()[6].value, 3 * 8 * p.particles.radius);  // centre_x: far faster than alone
}

TEST(Begin, GrainsAtOnePlaceAreANumericalErrorThatNamesThem) {
  Parameters p = disc(2);
  ThreadTeam team(1);
  Cloud cloud(p, two_grains(p, 0));
  try {
    cloud.begin(team);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("not finite"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("grain 0"), std::string::npos);
  }
}

TEST(Advance, StopsWhenAGrainSinksIntoTheSlope) {
  Parameters p = polystyrene(Shape::file, 1);
  p.motion = Motion::xz;
  p.contact.stiffness = 1e-3;  // its weight would press it 7 radii deep
  ThreadTeam team(1);
  Cloud cloud(p, {{{0, 0, p.particles.radius}}, {p.particles.radius}});
  cloud.begin(team);
  try {
    run_until(cloud, team, 10 * scales(p).stokes_time);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("contact.stiffness"), std::string::npos);
    EXPECT_LE(cloud.state().overlap[0], p.integration.max_overlap * p.particles.radius);
    EXPECT_GT(cloud.state().overlap[0], 0.9 * p.integration.max_overlap * p.particles.radius);
  }
}

TEST(Advance, SaysWhatHoldsTheStep) {
  using ::testing::HasSubstr;
  const auto limit = [](const Parameters& p) {
    ThreadTeam team(1);
    Cloud cloud(p, two_grains(p, 1.9));
    cloud.begin(team);
    for (int n = 0; n < 100; ++n) cloud.advance(team);
    return cloud.step_limit();
  };
  Parameters p = disc(2);
  EXPECT_THAT(limit(p).place, HasSubstr("grain "));
  p.integration.method = Method::euler;
  p.contact.stiffness *= 100;
  EXPECT_THAT(limit(p).term, HasSubstr("stability of the contacts"));
  EXPECT_EQ(limit(p).advice, "a smaller contact.stiffness");
}

}  // namespace
}  // namespace talus::cloud
