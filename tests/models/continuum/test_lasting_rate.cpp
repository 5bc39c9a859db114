// SPDX-License-Identifier: Apache-2.0
/// The shear by which densities in a vessel are drawn to the kernel's sum.
#include <gtest/gtest.h>

#include "models/continuum/cases.hpp"
#include "models/continuum/setup/initial.hpp"
#include "models/continuum/step.hpp"
#include "models/continuum/vessel_parts.hpp"

namespace talus::continuum {
namespace {

Parameters layer_on_a_plate() {
  Parameters p = column(4, 4, 3, 6);
  make_granular(p);
  p.box.floor = FaceKind::open;
  p.vessel = {plate("bottom", {-4, -4, 2}, {12, 0, 0}, {0, 12, 0})};
  p.bed.bottom = 2 * spacing;
  return p;
}

/// Size of the rate that lasts over that of the step, after ten times the time over which it is taken.
/// \param sign of the shear of a step
template <class Sign>
double share_that_lasts(const Parameters& p, Sign sign) {
  ThreadTeam team(1);
  const Setup setup = setup_of(p);
  State s = initial_state(setup);
  Workspace w(setup, s);
  begin(team, setup, s, w);
  constexpr int steps_of_time = 100;
  s.last_step = w.lasting_time / steps_of_time;
  for (int n = 0; n < 10 * steps_of_time; ++n) {
    for (double& slope : w.rates.velocity_gradient.component[2]) slope = 3.0 * sign(n);  // du_x/dz
    measure_shear_rate(team, s, w);
  }
  EXPECT_NEAR(s.shear_rate[0], 3, 1e-12) << "that of the step in any case";
  return shear_of(tensor_at(s.lasting_rate, 0)) / s.shear_rate[0];
}

TEST(LastingRate, IsThatOfASteadyShear) {
  EXPECT_NEAR(share_that_lasts(layer_on_a_plate(), [](int) { return 1; }), 1, 1e-4);
}

TEST(LastingRate, OfAJitterIsNextToNothing) {
  EXPECT_LT(share_that_lasts(layer_on_a_plate(), [](int n) { return n / 10 % 2 ? 1 : -1; }), 0.06);
}

/// Kernel's sum of the layer beside the plate over its density, after its layers were sheared by a strain of 0.5 in
/// all. \param steps after which the shear turns back
double sum_at_the_plate(double relaxation, int steps) {
  constexpr double rate = 5;  // 1/s
  Parameters p = layer_on_a_plate();
  p.box.left = p.box.right = FaceKind::periodic;
  p.integration.method = Method::leapfrog;
  p.sph.density_relaxation = relaxation;
  ThreadTeam team(1);
  Continuum model = started(p, team);
  State& s = model.mutable_state();
  double direction = 1;
  while (s.time < 0.5 / rate) {
    if (s.step % static_cast<std::uint64_t>(steps) == 0) direction = -direction;
    for (std::size_t i = 0; i < s.position.size(); ++i)
      s.velocity[i].x = direction * rate * (s.position[i].z - 3.5 * spacing);
    model.advance(team);
  }
  double sum = 0, density = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (s.position[i].z < 3 * spacing) sum += s.packing[i] * p.grains.density, density += s.density[i];
  return sum / density;
}

TEST(LastingRate, OfAJitterDrawsNoDensityThatOfAFlowDoes) {
  constexpr int never = 1 << 20;
  const auto drawn = [](int steps) { return sum_at_the_plate(0, steps) - sum_at_the_plate(1, steps); };
  EXPECT_GT(drawn(never), 0.001) << "beside a plate a lattice has a sum above its density";
  EXPECT_LT(std::abs(drawn(4)), 0.1 * drawn(never));
}

TEST(LastingRate, IsThereOnlyWhereItDraws) {
  const auto has_one = [](const Parameters& p) { return !initial_state(setup_of(p)).lasting_rate[0].empty(); };
  Parameters p = layer_on_a_plate();
  EXPECT_TRUE(has_one(p));
  p.sph.density_relaxation = 0;
  EXPECT_FALSE(has_one(p));
  p = layer_on_a_plate();
  p.vessel.clear();
  EXPECT_FALSE(has_one(p)) << "each step's shear draws there";
}

}  // namespace
}  // namespace talus::continuum
