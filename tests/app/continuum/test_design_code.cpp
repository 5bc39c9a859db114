// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/design_code.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "app/continuum/hand_formulas.hpp"
#include "app/continuum/wall_loads.hpp"
#include "io/scratch_folder.hpp"
#include "io/series.hpp"
#include "small_silo.hpp"

namespace talus::app {
namespace {

namespace code = granular::en1991;
using code::Limit;
using code::Load;

/// Wheat in a silo of 8 m on a flat floor, outlet in its middle, the bed 16 m deep; friction 0.38.
continuum::Parameters wheat_silo(double outlet_off_axis = 0) {
  continuum::Parameters p;
  p.box.width = p.box.depth = 10, p.box.height = 20;
  p.bed.spacing = 0.4, p.bed.packing = 0.6, p.grains.density = 1350;
  p.grains.material = continuum::GrainMaterial::wheat;
  p.walls.coefficient = 0.38;
  continuum::VesselPart wall, floor, gate;
  wall.name = "wall", wall.radius = 4, wall.bottom = 1, wall.top = 18;
  floor.name = "floor", floor.shape = continuum::VesselShape::disc, floor.radius = 4, floor.height = 1;
  gate.name = "gate", gate.shape = continuum::VesselShape::disc, gate.radius = 0.8, gate.height = 1, gate.gate = true;
  if (outlet_off_axis > 0) gate.centre = {5 + outlet_off_axis, 5};
  p.vessel = {wall, floor, gate};
  return p;
}

constexpr double top = 17, weight = 0.6 * 1350 * 9.81, upper_weight = 9e3;

TEST(CodeLoads, OfASlenderSiloAreItsUpperAndLowerValues) {
  const continuum::Layout layout(wheat_silo());
  const auto silo = silo_of_code(layout, top, {5, 5, 5});
  ASSERT_TRUE(silo);
  EXPECT_TRUE(silo->is_listed);
  EXPECT_NEAR(silo->silo.slenderness(), 2, 1e-12);
  EXPECT_EQ(code::class_of(silo->silo), code::Class::slender);
  EXPECT_TRUE(silo->silo.has_flat_bottom);
  EXPECT_NEAR(silo->eccentricity, 0, 1e-12);
  const auto bands = bands_of(layout);
  const CodeLoads loads = code_loads(layout, bands[0], top, 5);
  // p_h = gamma K z_o (1 - exp(-z/z_o)), z_o = d_c/(4 K mu), by hand.
  const auto by_hand = [&](double gamma, double K, double mu) {
    const double z_o = 8 / (4 * K * mu);
    return gamma * K * z_o * (1 - std::exp(-12 / z_o));
  };
  EXPECT_NEAR(loads.pressure_filling, by_hand(upper_weight, 0.54 * 1.11, 0.38 / 1.16), 1e-6);
  EXPECT_NEAR(loads.pressure_filling_lower, by_hand(weight, 0.54 / 1.11, 0.38 * 1.16), 1e-6);
  EXPECT_NEAR(loads.shear_filling, 0.38 * 1.16 * by_hand(upper_weight, 0.54 * 1.11, 0.38 * 1.16), 1e-6);
  EXPECT_NEAR(loads.pressure_discharge, 1.15 * loads.pressure_filling, 1e-9);
  EXPECT_NEAR(loads.pressure_discharge_lower, 1.15 * loads.pressure_filling_lower, 1e-9);
  EXPECT_NEAR(loads.shear_discharge, 1.10 * loads.shear_filling, 1e-9);
  EXPECT_TRUE(std::isnan(loads.in_channel)) << "the outlet is in the middle";
  EXPECT_TRUE(std::isnan(code_loads(layout, bands[0], top, 17.5).pressure_filling)) << "above the bed";
}

TEST(CodeLoads, OfAFloorAreTheVerticalOnes) {
  const continuum::Layout layout(wheat_silo());
  const auto bands = bands_of(layout);
  const auto floor = std::find_if(bands.begin(), bands.end(), [](const BandOfWall& b) { return b.patch == 1; });
  ASSERT_NE(floor, bands.end());
  const CodeLoads loads = code_loads(layout, *floor, top, 1);
  const auto silo = silo_of_code(layout, top, {5, 5, 1});
  EXPECT_NEAR(loads.pressure_filling, silo->filling(Load::bottom, Limit::upper, 1).vertical, 1e-6);
  EXPECT_EQ(loads.pressure_discharge, loads.pressure_filling);
  EXPECT_LT(loads.pressure_filling_lower, loads.pressure_filling);
  EXPECT_TRUE(std::isnan(loads.shear_filling));
}

TEST(CodeLoads, LevelPlatesCountAsAFloorWhereTheyCloseMostOfTheSection) {
  const auto bottom = [](double radius, double hole, double off_axis) {
    continuum::Parameters p = wheat_silo();
    continuum::VesselPart v;
    v.name = "platform", v.shape = continuum::VesselShape::disc, v.radius = radius, v.hole = hole, v.height = 9;
    v.centre = {5 + off_axis, 5};
    p.vessel.push_back(v);
    return silo_of_code(continuum::Layout(p), top, {5, 5, 9.5})->bottom;
  };
  EXPECT_EQ(bottom(4, 0, 0), 9);
  EXPECT_EQ(bottom(4, 1, 0), 9) << "a flat bottom with an outlet";
  EXPECT_EQ(bottom(4, 3.2, 0), 1) << "a ring along the wall";
  EXPECT_EQ(bottom(0.9, 0, 4.1), 1) << "outside of it";
}

TEST(CodeLoads, ASkirtBelowAHopperBearsNone) {
  continuum::Parameters p = small_silo();
  p.vessel[0].bottom = 0.03;  // the cylinder goes on below the cone's top
  const continuum::Layout layout(p);
  const SiloShape shape(layout);
  const auto silo = silo_of_code(shape, 0.15, {0.05, 0.05, 0.1});
  ASSERT_TRUE(silo);
  EXPECT_NEAR(silo->bottom, 0.09, 1e-12);
  EXPECT_FALSE(silo->silo.has_flat_bottom);
  BandOfWall band;
  EXPECT_TRUE(std::isfinite(code_loads(shape, band, 0.15, 0.1).pressure_filling));
  EXPECT_TRUE(std::isnan(code_loads(shape, band, 0.15, 0.05).pressure_filling));
  EXPECT_TRUE(std::isnan(pressure_by_hand(shape, band, 0.5, 0.15, 0.05).at_rest));
}

TEST(CodeLoads, ABandOfTwoWallsHasNone) {
  const continuum::Layout layout(wheat_silo());
  BandOfWall band = bands_of(layout)[0];
  band.sine = 0.2;
  EXPECT_TRUE(std::isnan(code_loads(layout, band, top, 5).pressure_filling));
  EXPECT_TRUE(std::isnan(pressure_by_hand(layout, band, 0.5, top, 5).at_rest));
}

TEST(CodeLoads, OfRingsAreOfTheMeanFrictionAboveAndTheShearOfTheirOwn) {
  continuum::Parameters p = wheat_silo();
  p.vessel.push_back(p.vessel[0]);
  p.vessel[0].top = p.vessel.back().bottom = 8;
  p.vessel.back().name = "upper", p.vessel.back().friction = 0.1;
  const auto silo = silo_of_code(continuum::Layout(p), top, {5, 5, 5});
  ASSERT_TRUE(silo);
  EXPECT_NEAR(silo->friction, (9 * 0.1 + 3 * 0.38) / 12, 1e-12);
  EXPECT_EQ(silo->own_friction, 0.38);
  const code::Stresses loads = silo->filling(Load::wall_shear, Limit::upper, 5);
  EXPECT_NEAR(loads.shear, 0.38 * 1.16 * loads.pressure, 1e-9);
}

TEST(CodeLoads, OfAnOutletFarFromTheAxisHaveAChannel) {
  const continuum::Layout near(wheat_silo(1.9)), far(wheat_silo(2.5));
  EXPECT_FALSE(silo_of_code(near, top, {5, 5, 5})->has_channel()) << "up to a quarter of the diameter";
  ASSERT_TRUE(silo_of_code(far, top, {5, 5, 5})->has_channel());
  const CodeLoads loads = code_loads(far, bands_of(far)[0], top, 5);
  EXPECT_GT(loads.in_channel, 0);
  EXPECT_LT(loads.in_channel, loads.pressure_filling);
  EXPECT_NEAR(loads.beside_channel, 2 * loads.pressure_filling - loads.in_channel, 1e-9)
      << "both are of the narrowest channel";
}

TEST(CodeLoads, OfAConeBalanceItsSlices) {
  const continuum::Parameters p = small_silo();
  const continuum::Layout layout(p);
  const auto bands = bands_of(layout);
  const double bed = 0.15;
  const auto silo = silo_of_code(layout, bed, {0.05, 0.05, 0.1});
  ASSERT_TRUE(silo);
  EXPECT_FALSE(silo->is_listed);
  EXPECT_FALSE(silo->silo.has_flat_bottom);
  EXPECT_EQ(code::class_of(silo->silo), code::Class::squat) << "6 cm of both";
  EXPECT_NEAR(silo->silo.height, 0.06, 1e-12);
  const double angle = std::numbers::pi / 6,
               internal = internal_friction_by_hand(p, granular::FrictionTest::shear_plane), ratio = 1.1 * 0.5 / 1.5;
  ASSERT_TRUE(code::is_steep(angle, 0.3 / 1.4, ratio));
  // At the transition the bed above is all that the cone bears.
  const double above = silo->filling(Load::bottom, Limit::upper, 0.09).vertical;
  const CodeLoads loads = code_loads(layout, bands[10], bed, 0.09);
  EXPECT_NEAR(loads.pressure_filling, code::hopper_filling(code::conical, angle, 0.3 / 1.4, ratio).ratio * above, 1e-6);
  EXPECT_NEAR(loads.pressure_discharge, granular::cone_in_flow(angle, 0.3 / 1.4, internal * 1.3).ratio * above, 1e-6);
  EXPECT_NEAR(loads.shear_discharge, 0.3 / 1.4 * loads.pressure_discharge, 1e-6);
  EXPECT_TRUE(std::isnan(code_loads(layout, bands.back(), bed, 0.06).pressure_filling)) << "the lid of a cone";
}

TEST(CodeLoads, AreNoneWhereTheWallsLieOrHaveNoFormula) {
  continuum::Parameters p = small_silo();
  const auto bands = bands_of(continuum::Layout(p));
  for (continuum::VesselPart& wall : p.vessel) wall.along = continuum::Along::y;
  for (const std::size_t band : {2, 10})
    EXPECT_TRUE(std::isnan(code_loads(continuum::Layout(p), bands[band], 0.15, 0.1).pressure_filling));
}

TEST(PatchOfCode, IsAtTheCharacteristicDepthOrHalfTheHeight) {
  const continuum::Layout layout(wheat_silo(1));
  const auto silo = silo_of_code(layout, top, {5, 5, 5});
  const CodePatch patch = patch_of_code(*silo);
  const double z_o = 8 / (4 * 0.54 * 1.11 * 0.38 / 1.16), z = std::min(z_o, 8.0);
  EXPECT_NEAR(patch.height, top - z, 1e-9);
  EXPECT_NEAR(patch.extent, std::numbers::pi / 2, 1e-12);
  const double pressure = silo->filling(Load::wall_pressure, Limit::upper, top - z).pressure;
  EXPECT_NEAR(patch.filling, 0.21 * 0.5 * (1 - std::exp(-1.5)) * pressure, 1e-6);
  EXPECT_NEAR(patch.discharge, 0.42 * 0.5 * (1 + 2 * 0.0625) * (1 - std::exp(-1.5)) * 1.15 * pressure, 1e-6);
}

TEST(DesignCode, SaysWhatItTakes) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "analysis");
  const continuum::Layout layout(wheat_silo(2.5));
  EXPECT_TRUE(answers_of_code(layout, scratch.path()).empty()) << "without a table";
  write_design_code(scratch.path(), layout, top);
  const Series table = read_series(scratch / "analysis" / "en1991.csv");
  ASSERT_EQ(table.rows(), 1u);
  EXPECT_EQ(table.column("h_c").front(), 16);
  EXPECT_NEAR(table.column("K_for_bottom").front(), 0.54 / 1.11, 1e-12);
  EXPECT_NEAR(table.column("unit_weight").front(), upper_weight, 1e-9 * weight);
  const std::vector<Answer> answers = answers_of_code(layout, scratch.path());
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_EQ(answers[0].question, "EN 1991-4 takes, wall");
  EXPECT_EQ(answers[0].answer, "slender: h_c/d_c 2, 9 kN/m³ (upper)");
  EXPECT_EQ(answers[0].by_hand,
            "wheat, Table E.1; wall pressure by K 0.599 (upper), μ 0.328 (lower), φ_i 26.8° (lower); floor and cone's "
            "top by C_b 1, K 0.486 (lower), μ 0.328 (lower), φ_i 33.6° (upper)");
  EXPECT_EQ(answers[1].question, "Patch load, wall");
  EXPECT_EQ(answers[2].question, "Flow channel, wall");
  EXPECT_EQ(answers[2].answer, "outlet off the axis by 0.31 d_c, above 0.25");
}

TEST(DesignCode, SaysWhatItTakesForAHopper) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "analysis");
  continuum::Parameters p = small_silo();
  const auto first = [&] {
    const continuum::Layout layout(p);
    write_design_code(scratch.path(), layout, 0.15);
    return answers_of_code(layout, scratch.path()).front();
  };
  EXPECT_EQ(first().question, "EN 1991-4 takes, cone");
  EXPECT_EQ(first().answer, "steep: half angle 30°, K 0.367 (lower)");
  EXPECT_EQ(first().by_hand, "filling by μ 0.214 (lower); discharge by μ 0.214 (lower), φ_i 39° (upper)");
  p.walls.coefficient = 0.9;
  p.vessel[1].bottom = p.vessel[2].height = 0.075;
  EXPECT_EQ(first().answer, "shallow: half angle 49.1°, K 0.367 (lower)");
  EXPECT_EQ(first().by_hand, "filling by μ 0.426 (lower); discharge as filling")
      << "no wall is rougher than the grains";
}

}  // namespace
}  // namespace talus::app
