// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/en1991.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/unit.hpp"

namespace talus::granular::en1991 {
namespace {

constexpr double pi = std::numbers::pi;

Silo round_silo(double diameter, double height) {
  return {0.25 * pi * diameter * diameter, pi * diameter, diameter, height};
}

const Solid wheat{34 * degree, 30 * degree, 1.12, 0.54, 1.11, 1.16, 0.5};
const Values mean{0.38, 0.54, 30 * degree};

TEST(En1991, GivesTheWorkedExampleOfWheat) {
  // A design memo: 8 m by 15 m, which its author computes as slender at h_c/d_c
  // = 1.875.
  const Silo silo = round_silo(8, 15), deep = round_silo(8, 16);
  const double z_o = characteristic_depth(silo, mean);
  EXPECT_NEAR(z_o, 9.74, 0.01 * 9.74);
  EXPECT_NEAR(9e3 * mean.ratio * z_o, 47.3e3, 0.01 * 47.3e3);
  const Stresses wall = filling(deep, wheat.repose, mean, 9e3, 15);
  EXPECT_NEAR(wall.pressure, 37.1e3, 0.01 * 37.1e3);
  EXPECT_NEAR(wall.shear, 14.11e3, 0.01 * 14.11e3);
  EXPECT_NEAR(discharge_factors(deep).pressure * wall.pressure, 42.7e3, 0.01 * 42.7e3);
}

TEST(En1991, GivesTheWorkedExampleOfCement) {
  Silo silo = round_silo(5, 6);
  silo.area = 1.2495 * silo.circumference;
  const Values values{0.458, 0.45, 30 * degree};
  EXPECT_NEAR(characteristic_depth(silo, values), 6.07, 0.01 * 6.07);
  EXPECT_NEAR(contact_depth(silo, 36 * degree), 0.61, 0.01 * 0.61);
  EXPECT_TRUE(is_steep(std::atan(0.599), 0.458, 0.45));
  EXPECT_FALSE(is_steep(std::atan(0.602), 0.458, 0.45)) << "the limit is 0.60";
  EXPECT_FALSE(is_steep(39.8 * degree, 0.458, 0.45)) << "the example's hopper";
}

TEST(En1991, ClassesAreByHeightOverWidth) {
  EXPECT_EQ(class_of(round_silo(1, 2)), Class::slender);
  EXPECT_EQ(class_of(round_silo(1, 1.99)), Class::intermediate);
  EXPECT_EQ(class_of(round_silo(1, 1)), Class::squat);
  EXPECT_EQ(class_of(round_silo(1, 0.4)), Class::retaining);
  Silo above_a_hopper = round_silo(1, 0.4);
  above_a_hopper.has_flat_bottom = false;
  EXPECT_EQ(class_of(above_a_hopper), Class::squat);
}

TEST(En1991, EverySliceIsInBalance) {
  // gamma A z is what is below and what the walls took, of each class; smooth walls take nothing.
  for (const double height : {0.3, 0.9, 1.5, 2.5})
    for (const double friction : {0.0, 0.38}) {
      const Silo silo = round_silo(1, height);
      const Values values{friction, 0.54, 30 * degree};
      const double from = contact_depth(silo, wheat.repose), weight = 8e3;
      double held = 0;
      constexpr int slices = 4000;
      const double step = (height - from) / slices;
      for (int n = 0; n < slices; ++n)
        held += filling(silo, wheat.repose, values, weight, from + (n + 0.5) * step).shear * silo.circumference * step;
      const double below = filling(silo, wheat.repose, values, weight, height).vertical * silo.area;
      EXPECT_NEAR(held + below, weight * silo.area * height, 1e-5 * weight * silo.area * height) << height;
    }
}

TEST(En1991, LoadsBeginAtTheContactWithTheWallAndEndAtTheAsymptote) {
  Silo squat = round_silo(1, 0.9);
  const double contact = contact_depth(squat, wheat.repose);
  EXPECT_NEAR(contact, std::tan(34 * degree) / 6, 1e-12);
  EXPECT_EQ(filling(squat, wheat.repose, mean, 8e3, contact).pressure, 0);
  EXPECT_NEAR(filling(squat, wheat.repose, mean, 8e3, contact * (1 + 1e-9)).vertical, 8e3 * contact, 1e-3);
  const double most = 8e3 * 0.54 * characteristic_depth(squat, mean);
  EXPECT_NEAR(filling(squat, wheat.repose, mean, 8e3, 1e5).pressure, most, 1e-2 * most);
  EXPECT_NEAR(filling(round_silo(1, 2), wheat.repose, mean, 8e3, 50).pressure, most, 1e-6 * most);
  EXPECT_EQ(filling(round_silo(1, 2), wheat.repose, mean, 8e3, 0).pressure, 0);
  squat.is_round = false;
  EXPECT_NEAR(contact_depth(squat, wheat.repose), std::tan(34 * degree) / 4, 1e-12);
}

TEST(En1991, ExponentOfMinusOneIsContinuous) {
  // (1 + tan phi_r)(1 - h_o/z_o) = 1.
  const Silo silo = round_silo(1, 0.9);
  const double contact = contact_depth(silo, wheat.repose), slope = 1 + std::tan(wheat.repose);
  const double depth = contact / (1 - 1 / slope), friction = silo.area / (silo.circumference * 0.54 * depth);
  const auto at = [&](double mu) { return filling(silo, wheat.repose, {mu, 0.54, 0.5}, 8e3, 0.8).vertical; };
  EXPECT_NEAR(at(friction), at(friction * (1 + 1e-6)), 1e-5 * at(friction));
}

TEST(En1991, DischargeFactorsRiseFromSquatToSlender) {
  EXPECT_EQ(discharge_factors(round_silo(1, 0.9)).pressure, 1);
  EXPECT_NEAR(discharge_factors(round_silo(1, 1.5)).pressure, 1.075, 1e-12);
  EXPECT_NEAR(discharge_factors(round_silo(1, 1.5)).shear, 1.05, 1e-12);
  EXPECT_EQ(discharge_factors(round_silo(1, 2)).pressure, 1.15);
  EXPECT_EQ(discharge_factors(round_silo(1, 2)).shear, 1.10);
}

TEST(En1991, PatchLoadsGrowWithHeightAndEccentricity) {
  // By hand: 0.21 0.5 (1 - e^-1.5), 0.42 0.5 (1 + 2 0.2^2)(1 - e^-1.5), 0.272 0.5 (0.1 + 0.2).
  const Silo deep = round_silo(1, 2);
  EXPECT_NEAR(patch_of_filling(deep, 0.5, 0), 0.105 * 0.7769, 1e-4);
  EXPECT_NEAR(patch_of_discharge(deep, 0.5, 0.1), 0.21 * 1.08 * 0.7769, 1e-4);
  EXPECT_NEAR(patch_of_discharge(round_silo(1, 1.1), 0.5, 0.1), 0.0408, 1e-12);
  EXPECT_EQ(patch_of_filling(round_silo(1, 0.9), 0.5, 0), 0);
  EXPECT_EQ(patch_of_discharge(round_silo(1, 0.9), 0.5, 0), 0);
  EXPECT_NEAR(patch_extent(deep), 0.196, 1e-3);
}

TEST(En1991, CharacteristicValuesMakeEachLoadLargestOrSmallest) {
  const Values wall = values_for(wheat, 0.38, Load::wall_pressure, Limit::upper);
  EXPECT_NEAR(wall.friction, 0.38 / 1.16, 1e-12);
  EXPECT_NEAR(wall.ratio, 0.54 * 1.11, 1e-12);
  EXPECT_NEAR(wall.internal, 30 * degree / 1.12, 1e-12);
  EXPECT_NEAR(values_for(wheat, 0.38, Load::hopper_discharge, Limit::upper).internal, 30 * degree * 1.12, 1e-12);
  EXPECT_EQ(values_for(wheat, 0.38, Load::bottom, Limit::mean).ratio, 0.54);
  const Silo silo = round_silo(8, 20);
  const auto of = [&](Load load, Limit limit) {
    const Stresses s = filling(silo, wheat.repose, values_for(wheat, 0.38, load, limit), 9e3, 15);
    return load == Load::wall_pressure ? s.pressure : load == Load::wall_shear ? s.shear : s.vertical;
  };
  for (const Load load : {Load::wall_pressure, Load::wall_shear, Load::bottom}) {
    EXPECT_LT(of(load, Limit::lower), of(load, Limit::mean));
    EXPECT_LT(of(load, Limit::mean), of(load, Limit::upper));
  }
  EXPECT_NEAR(values_for(wheat, 0.9, Load::wall_pressure, Limit::upper).friction, std::tan(30 * degree / 1.12), 1e-12)
      << "no wall is rougher than the grains";
  EXPECT_NEAR(values_for(wheat, 0.9, Load::wall_shear, Limit::upper).friction, std::tan(30 * degree * 1.12), 1e-12);
  const Solid unknown = unknown_solid(30 * degree);
  EXPECT_NEAR(unknown.ratio, 0.55, 1e-12);
  EXPECT_EQ(unknown.repose, unknown.internal);
}

TEST(En1991, ChannelIsTheAreaThatTwoCirclesShare) {
  // Counted on a fine grid.
  const FlowChannel channel = flow_channel(2, 0.4, mean);
  EXPECT_GT(channel.half_angle, 0);
  double shared = 0;
  constexpr double cell = 2e-3;
  for (double x = -2; x < 3; x += cell)
    for (double y = -2; y < 2; y += cell)
      if (std::hypot(x, y) < 2 && std::hypot(x - channel.offset, y) < channel.radius) shared += cell * cell;
  EXPECT_NEAR(channel.area, shared, 2e-3 * shared);
  EXPECT_NEAR(channel.on_wall, 4 * channel.half_angle, 1e-12);
  EXPECT_NEAR(channel_pressure(channel, 9e3, 1e4), 9e3 * 0.54 * channel.depth, 1);
}

TEST(En1991, ChannelWhereItOnlyTouchesTheWallIsACircle) {
  for (const double friction : {0.0, std::tan(30 * degree), 0.9}) {
    const FlowChannel channel = flow_channel(2, 0.25, {friction, 0.54, 30 * degree});
    EXPECT_NEAR(channel.offset, 1.5, 1e-9);
    EXPECT_NEAR(channel.half_angle, 0, 1e-6);
    EXPECT_NEAR(channel.area, pi * 0.25, 1e-6);
    EXPECT_NEAR(channel.on_bed, pi, 1e-6);
    EXPECT_NEAR(channel.depth, 0.125 * 2 / (0.54 * std::tan(30 * degree)), 1e-5) << "r_c/2 over K tan phi_i";
  }
}

TEST(En1991, HoppersBearWhatBalances) {
  const double angle = 20 * degree, mu = 0.3;
  EXPECT_TRUE(is_steep(angle, mu, 0.5));
  for (const double shape : {conical, 1.5, wedge}) {
    const ConeBearing filled = hopper_filling(shape, angle, mu, 0.5);
    EXPECT_NEAR(filled.ratio, 1 - 0.2 / (1 + std::tan(angle) / mu), 1e-12);
    EXPECT_NEAR(filled.exponent, shape * 0.8 * mu / std::tan(angle), 1e-12);
  }
  // As the code prints it, where S = 2.
  const ConeBearing flows = hopper_discharge(conical, angle, {mu, 0.5, 30 * degree});
  EXPECT_EQ(flows.ratio, cone_in_flow(angle, mu, 30 * degree).ratio);
  EXPECT_NEAR(flows.exponent, 2 * (flows.ratio * mu / std::tan(angle) + flows.ratio) - 2, 1e-12);
  // What a wedge's slice bears: d(p 2 x tan beta) = -gamma 2 x tan beta dx + 2 F p (tan beta + mu) dx.
  const ConeBearing of_wedge = hopper_discharge(wedge, angle, {mu, 0.5, 30 * degree});
  const double step = 1e-6, x = 0.4, weight = 8e3, t = std::tan(angle);
  const auto load = [&](double at) { return 2 * at * t * cone_stress(of_wedge, weight, at, 1, 5e3); };
  const double pressure = cone_stress(of_wedge, weight, x, 1, 5e3);
  EXPECT_NEAR((load(x + step) - load(x - step)) / (2 * step),
              2 * of_wedge.ratio * pressure * (t + mu) - 2 * weight * x * t, 1e-3 * weight);
}

TEST(En1991, ShallowHoppersMobiliseAPartOfTheirFriction) {
  const double angle = 60 * degree, mu = 0.4, effective = (1 - 0.5) / (2 * std::tan(angle));
  EXPECT_FALSE(is_steep(angle, mu, 0.5));
  EXPECT_NEAR(hopper_friction(angle, mu, 0.5), effective, 1e-12);
  EXPECT_NEAR(hopper_filling(conical, angle, mu, 0.5).ratio, 1 - 0.2 / (1 + std::tan(angle) / effective), 1e-12);
  EXPECT_EQ(hopper_discharge(conical, angle, {mu, 0.5, 0.5}).ratio, hopper_filling(conical, angle, mu, 0.5).ratio);
  EXPECT_EQ(hopper_filling(conical, angle, 0, 0.5).ratio, 1) << "smooth: as a liquid";
}

TEST(En1991, FlatBottomsBearThePileToo) {
  const Silo deep = round_silo(1, 2), squat = round_silo(1, 0.9);
  EXPECT_EQ(bottom_pressure(deep, wheat.repose, mean, 8e3), filling(deep, wheat.repose, mean, 8e3, 2).vertical);
  // The pile is a cone of the angle of repose.
  const double contact = contact_depth(squat, wheat.repose), pile = 0.5 * std::tan(wheat.repose);
  EXPECT_NEAR(bottom_pressure(squat, wheat.repose, mean, 8e3) - filling(squat, wheat.repose, mean, 8e3, 0.9).vertical,
              8e3 * (pile - contact) * 1.1 / (2 - pile), 1e-9);
}

}  // namespace
}  // namespace talus::granular::en1991
