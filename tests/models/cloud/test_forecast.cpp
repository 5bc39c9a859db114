// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "models/cloud/cases.hpp"

namespace talus::cloud {
namespace {

/// The steps and evaluations that a run takes are those of its forecast, within a factor of 1.5 either way.
void expect_forecast(const std::string& name, const Parameters& p, double end) {
  ThreadTeam team(1);
  Cloud cloud = started(p, team);
  run_until(cloud, team, end);
  const Forecast f = forecast(p, end, static_cast<double>(p.particles.count));
  EXPECT_LT(std::abs(std::log(f.steps / static_cast<double>(cloud.state().step))), std::log(1.5))
      << name << ": forecast " << f.steps << ", taken " << cloud.state().step;
  EXPECT_LT(std::abs(std::log(f.evaluations / static_cast<double>(cloud.state().evaluations))), std::log(1.5))
      << name << ": forecast " << f.evaluations << ", made " << cloud.state().evaluations;
}

Parameters heap(std::int64_t count) {
  Parameters p = polystyrene(Shape::dome, count);
  p.motion = Motion::xyz;
  p.fluid.mobility = hydrodynamics::Mobility::zuk_2014;
  p.contact.stiffness = 40;
  p.particles.size = 0.2 * std::cbrt(static_cast<double>(count) / 10000);
  return p;
}

Parameters triangle(std::int64_t count) {
  Parameters p = polystyrene(Shape::wedge, count);
  p.motion = Motion::xz;
  p.particles.size = 0.6 * std::sqrt(static_cast<double>(count) / 2000);
  return p;
}

TEST(CloudForecast, OfADiscThatIsFree) {
  expect_forecast("disc", disc(100), 3e-3);
}

// Three to four times as many stages as of the same grains in the air: the layer on the slope gives way as one.
TEST(CloudForecast, OfGrainsPressedAgainstASlope) {
  expect_forecast("triangle", triangle(150), 3e-3);
  expect_forecast("heap", heap(60), 3e-3);
  expect_forecast("larger heap", heap(200), 3e-3);
}

TEST(CloudForecast, OfBallsInALiquid) {
  Parameters p = polystyrene(Shape::ball, 100);
  p.motion = Motion::xyz;
  p.fluid = {.density = 970, .viscosity = 1, .mobility = hydrodynamics::Mobility::zuk_2014};
  p.particles.radius = 0.5e-3, p.particles.density = 2500, p.particles.size = 9.3e-3;
  p.slope.enabled = false;
  p.gravity.direction = {0, 0, -1};
  expect_forecast("ball", p, 20);
}

TEST(CloudForecast, OfFreeGrainsByDormandAndPrince) {
  Parameters p = disc(100);
  p.contact.enabled = false;
  p.integration.method = Method::dormand_prince;
  expect_forecast("disc", p, 3e-3);
}

TEST(CloudForecast, RefusesWhatNoMachineComesToTheEndOf) {
  Parameters p = disc(100);
  EXPECT_FALSE(check_steps(p, 1));
  const auto problem = check_steps(p, 1e9);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->key, "run.end");
}

TEST(CloudSample, HasAsManyGrainsApartFromEachOther) {
  for (const Motion motion : {Motion::xy, Motion::xz, Motion::xyz}) {
    Parameters p = disc(100);
    p.motion = motion;
    const Grains grains = sample(p, 50);
    ASSERT_EQ(grains.position.size(), 50u);
    EXPECT_TRUE(check_grains(p, grains).empty());
  }
}

TEST(CheckGrains, FindsThoseWithinEachOther) {
  Parameters p = disc(3);
  const double a = p.particles.radius;
  const auto problems_at = [&](double distance) {
    return check_grains(p, {{{0, 0, 0}, {1, 0, 0}, {1 + distance, 0, 0}}, {a, a, a}});
  };
  EXPECT_TRUE(problems_at(1.51 * a).empty());
  ASSERT_EQ(problems_at(1.49 * a).size(), 1u);
  EXPECT_EQ(problems_at(0.5 * a).front().what, "1 pair overlap too much; points 2 and 3 by 1.5 radii");
  p.contact.enabled = false;  // overlaps repel nobody, but two grains at one place have no finite velocity
  EXPECT_TRUE(problems_at(0.5 * a).empty());
  EXPECT_EQ(problems_at(0).size(), 1u);
  p.fluid.mobility = hydrodynamics::Mobility::zuk_2014;
  EXPECT_TRUE(problems_at(0).empty());
}

TEST(CheckGrains, FindsThoseWithinTheSlope) {
  Parameters p = triangle(2);
  const double a = p.particles.radius;
  EXPECT_TRUE(check_grains(p, {{{0, 0, a}, {1, 0, 0.6 * a}}, {a, a}}).empty());
  const auto problems = check_grains(p, {{{0, 0, a}, {1, 0, 0.4 * a}}, {a, a}});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems.front().what, "1 point of grains within the slope; point 2 lies at z = 0.002 m");
}

}  // namespace
}  // namespace talus::cloud
