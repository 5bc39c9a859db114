// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/silo_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/continuum/design_code.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "app/continuum/wall_loads.hpp"
#include "small_silo.hpp"

namespace talus::app {
namespace {

using continuum::VesselPart;
using continuum::VesselShape;

VesselPart plate(std::string name, std::array<double, 3> corner, std::array<double, 3> first,
                 std::array<double, 3> second) {
  VesselPart v;
  v.name = std::move(name), v.shape = VesselShape::plate;
  v.corner = corner, v.first_edge = first, v.second_edge = second;
  return v;
}

/// A bunker 3 m wide, 1.5 m of its length between the faces of the box: upright plates from 3 m to 10 m on two that
/// narrow to a slot of 0.75 m at 1 m.
continuum::Parameters bunker() {
  continuum::Parameters p;
  p.box.width = 3.4, p.box.depth = 1.5, p.box.height = 10.5;
  p.bed.spacing = 0.125, p.bed.packing = 0.6, p.grains.density = 1250;
  p.walls.coefficient = 0.3;
  p.vessel = {plate("left", {0.2, 0, 3}, {0, 0, 7}, {0, 1.5, 0}), plate("right", {3.2, 0, 3}, {0, 0, 7}, {0, 1.5, 0}),
              plate("lower left", {1.325, 0, 1}, {-1.125, 0, 2}, {0, 1.5, 0}),
              plate("lower right", {2.075, 0, 1}, {1.125, 0, 2}, {0, 1.5, 0}),
              plate("gate", {1.325, 0, 1}, {0.75, 0, 0}, {0, 1.5, 0})};
  p.vessel.back().gate = true;
  return p;
}

/// An upright box of 1 m by `depth` about the middle of a slice 0.1 m deep between planes of symmetry.
TEST(SiloShape, OfABoxHasTheWallsThatGrainsMeet) {
  const auto of = [](double depth, double middle) {
    continuum::Parameters p;
    p.box.width = 1.2, p.box.depth = 0.1, p.box.height = 3;
    p.bed.spacing = 0.02, p.walls.coefficient = 0.3;
    VesselPart v;
    v.name = "bin", v.shape = VesselShape::box, v.width = 1, v.depth = depth, v.bottom = 0.5, v.top = 2.5;
    v.centre = {0.6, middle};
    p.vessel = {v};
    const continuum::Layout layout(p);
    const SiloShape shape(layout);
    EXPECT_EQ(shape.pieces.size(), 1u);
    return std::pair(shape.pieces[0].area / shape.pieces[0].circumference, shape.pieces[0].width);
  };
  for (const double depth : {0.11, 0.4}) {
    EXPECT_NEAR(of(depth, 0.05).first, 0.5, 1e-12) << "neither front nor rear";
    EXPECT_NEAR(of(depth, 0.05).second, 1, 1e-12);
  }
  EXPECT_NEAR(of(0.16, 0).first, 0.16 / 2 / 1.16, 1e-12) << "half of it, cut through its middle";
  EXPECT_NEAR(of(0.08, 0.05).first, 0.08 / 2 / 1.08, 1e-12) << "all of it";
}

TEST(SiloShape, OfPlatesAreUprightWallsOnAWedge) {
  const continuum::Layout layout(bunker());
  const SiloShape shape(layout);
  ASSERT_EQ(shape.pieces.size(), 2u);
  const SiloPiece &wedge = shape.pieces[0], &walls = shape.pieces[1];
  EXPECT_NEAR(wedge.bottom, 1, 1e-6);
  EXPECT_NEAR(wedge.top, 3, 1e-6);
  EXPECT_NEAR(wedge.tangent, 1.125 / 2, 1e-12);
  EXPECT_NEAR(wedge.shape(), 1, 1e-5) << "planes of symmetry end it";
  EXPECT_NEAR(wedge.width, 3, 1e-4);
  EXPECT_NEAR(wedge.apex(), 1 - 0.375 / (1.125 / 2), 1e-4);
  EXPECT_EQ(wedge.parts, (std::vector<std::size_t>{2, 3}));
  EXPECT_NEAR(walls.bottom, 3, 1e-6);
  EXPECT_NEAR(walls.top, 10, 1e-6);
  EXPECT_FALSE(walls.is_hopper());
  EXPECT_FALSE(walls.is_round);
  EXPECT_NEAR(walls.width, 3, 1e-5);
  EXPECT_NEAR(walls.area, 4.5, 1e-6);
  EXPECT_NEAR(walls.hydraulic_radius(), 1.5, 1e-6);
  EXPECT_NEAR(walls.friction, 0.3, 1e-12);
  EXPECT_EQ(shape.name_of(walls), "left, right");
  EXPECT_EQ(shape.of_part(2, 2), &wedge);
  EXPECT_EQ(shape.of_part(2, 5), nullptr);
  EXPECT_EQ(shape.upright_at({1.7, 0.75, 2}), &walls);
}

TEST(SiloShape, WallsAcrossTheEndsOfASlotAreOfItsSection) {
  continuum::Parameters p = bunker();
  p.box.depth = 2, p.box.front = FaceKind::wall;
  p.vessel.push_back(plate("end", {0.1, 1.5, 1}, {3.2, 0, 0}, {0, 0, 9}));
  const SiloShape shape{continuum::Layout(p)};
  ASSERT_EQ(shape.pieces.size(), 2u);
  EXPECT_NEAR(shape.pieces[1].width, 1.5, 1e-5);
  EXPECT_NEAR(shape.pieces[1].hydraulic_radius(), 4.5 / 9, 1e-6);
  EXPECT_NEAR(shape.pieces[0].shape(), 1, 1e-4) << "upright ends of a wedge do not narrow";
}

/// The walls of small_silo() as pyramids and boxes have them, one inside the other's circle.
TEST(SiloShape, OfAPyramidIsAHopperAsSteepAsACone) {
  continuum::Parameters p = small_silo();
  p.vessel[0].shape = VesselShape::box, p.vessel[0].width = p.vessel[0].depth = 0.06;
  VesselPart& pyramid = p.vessel[1];
  pyramid.shape = VesselShape::pyramid;
  pyramid.upper_width = pyramid.upper_depth = 0.06, pyramid.lower_width = pyramid.lower_depth = 0.03;
  const continuum::Layout layout(p);
  const SiloShape shape(layout);
  ASSERT_EQ(shape.pieces.size(), 2u);
  EXPECT_NEAR(shape.pieces[0].shape(), 2, 1e-4);
  EXPECT_NEAR(shape.pieces[0].tangent, 0.5, 1e-9);
  EXPECT_NEAR(shape.pieces[0].top, 0.09, 1e-7);
  EXPECT_NEAR(shape.pieces[0].bottom, 0.06, 1e-7);
  EXPECT_FALSE(shape.pieces[0].is_round);
  EXPECT_EQ(shape.pieces[1].parts, std::vector<std::size_t>{0}) << "a box is itself";
}

/// The same silo by triangles, 90 to a turn.
continuum::Parameters drawn_silo() {
  continuum::Parameters p = small_silo();
  std::vector<Triangle> triangles;
  constexpr int turn = 90;
  const double lower = p.vessel[1].lower_radius;
  const auto at = [&](int n, double radius, double z) {
    const double angle = 2 * std::numbers::pi * n / turn;
    return Vector3{0.05 + radius * std::cos(angle), 0.05 + radius * std::sin(angle), z};
  };
  const auto band = [&](double r0, double z0, double r1, double z1) {
    for (int n = 0; n < turn; ++n) {
      triangles.push_back({{at(n, r0, z0), at(n + 1, r0, z0), at(n + 1, r1, z1)}, 0});
      triangles.push_back({{at(n, r0, z0), at(n + 1, r1, z1), at(n, r1, z1)}, 0});
    }
  };
  band(lower, 0.06, 0.03, 0.09), band(0.03, 0.09, 0.03, 0.17);
  VesselPart drawn;
  drawn.name = "drawn", drawn.shape = VesselShape::stl, drawn.file = "silo.stl", drawn.unit = continuum::FileUnit::m;
  drawn.drawn = std::make_shared<continuum::DrawnSurface>(triangles);
  p.vessel = {drawn, p.vessel[2]};
  return p;
}

TEST(SiloShape, OfAFileIsThatOfTheShapesItHolds) {
  const continuum::Layout drawn(drawn_silo()), exact(small_silo());
  const SiloShape found(drawn), known(exact);
  ASSERT_EQ(found.pieces.size(), 2u);
  ASSERT_EQ(known.pieces.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) {
    const SiloPiece &f = found.pieces[n], &k = known.pieces[n];
    EXPECT_NEAR(f.bottom, k.bottom, 1e-6);
    EXPECT_NEAR(f.top, k.top, 1e-6);
    EXPECT_NEAR(f.area, k.area, 0.001 * k.area);
    EXPECT_NEAR(f.circumference, k.circumference, 0.001 * k.circumference);
    EXPECT_NEAR(f.width, k.width, 0.001 * k.width);
    EXPECT_NEAR(f.tangent, k.tangent, 0.001 * k.tangent);
    EXPECT_TRUE(f.is_round);
    EXPECT_NEAR(f.axis.x, 0.05, 1e-4);
  }
}

TEST(SiloShape, GivesWallsOfAFileTheirEstimates) {
  const continuum::Layout drawn(drawn_silo()), exact(small_silo());
  const auto same = [](double found, double known) {
    if (std::isnan(known))
      EXPECT_TRUE(std::isnan(found));
    else
      EXPECT_NEAR(found, known, 0.01 * known);
  };
  for (const double height : {0.075, 0.0915, 0.12}) {  // the second less than a spacing above the cone
    BandOfWall of_drawn, of_exact;
    of_exact.patch = height < 0.09 ? 1 : 0;
    of_drawn.sine = of_exact.sine = height < 0.09 ? 0.5 : 0;
    const PressureByHand hand = pressure_by_hand(drawn, of_drawn, 0.5, 0.15, height),
                         known = pressure_by_hand(exact, of_exact, 0.5, 0.15, height);
    same(hand.at_rest, known.at_rest), same(hand.in_flow, known.in_flow);
    const CodeLoads code = code_loads(drawn, of_drawn, 0.15, height),
                    known_code = code_loads(exact, of_exact, 0.15, height);
    ASSERT_TRUE(std::isfinite(known_code.pressure_discharge));
    same(code.pressure_filling, known_code.pressure_filling);
    same(code.pressure_discharge, known_code.pressure_discharge);
    same(code.shear_discharge, known_code.shear_discharge);
  }
}

TEST(SiloShape, TheLoadsOfAWedgeBalanceItsSlices) {
  const continuum::Layout layout(bunker());
  const SiloShape shape(layout);
  BandOfWall band;
  band.patch = 2;
  const double top = 9, weight = 0.6 * 1250 * 9.81, angle = std::atan(1.125 / 2), step = 1e-4;
  band.sine = std::sin(angle);
  // Of a slice between two planes: d(sigma x)/dx = p (1 + mu/tan beta) - weight x, x from where they would meet.
  const auto vertical = [&](double z) {
    return pressure_by_hand(shape, band, 0.5, top, z).in_flow /
           granular::cone_in_flow(angle, 0.3, internal_friction_by_hand(layout.given)).ratio;
  };
  const double z = 2, x = z - shape.pieces[0].apex();
  const double force = (vertical(z + step) * (x + step) - vertical(z - step) * (x - step)) / (2 * step);
  const double carried = pressure_by_hand(shape, band, 0.5, top, z).in_flow * (1 + 0.3 / std::tan(angle));
  EXPECT_NEAR(force, carried - weight * x, 1e-3 * carried);
}

TEST(SiloShape, OfSeveralUprightWallsHasThoseAboutAPlace) {
  continuum::Parameters p = small_silo();
  p.box.width = 0.2;
  for (continuum::VesselPart& part : p.vessel) part.centre = {0.04, 0.05};
  p.vessel.push_back(p.vessel[0]);
  p.vessel.back().centre = {0.14, 0.05}, p.vessel.back().radius = 0.05, p.vessel.back().bottom = 0.02;
  const continuum::Layout beside(p);
  const SiloShape bins(beside);
  EXPECT_EQ(bins.upright_at({0.04, 0.05, 0.1})->parts.front(), 0u);
  EXPECT_EQ(bins.upright_at({0.14, 0.05, 0.1})->parts.front(), 3u);
  p.vessel.back().centre = {0.04, 0.05}, p.vessel.back().radius = 0.04;
  const continuum::Layout clad(p);
  EXPECT_EQ(SiloShape(clad).upright_at({0.04, 0.05, 0.1})->parts.front(), 0u) << "the outlet is within these";
  p.vessel.erase(p.vessel.begin() + 1, p.vessel.begin() + 3);
  const continuum::Layout column(p);
  EXPECT_EQ(SiloShape(column).upright_at({0.04, 0.05, 0.1}), nullptr) << "a bed about a column";
}

TEST(SiloShape, HasNoPieceOfWhatIsNoSilo) {
  continuum::Parameters p = bunker();
  p.vessel.erase(p.vessel.begin() + 1, p.vessel.begin() + 4);  // one wall, and a floor
  p.box.right = FaceKind::open;
  EXPECT_TRUE(SiloShape(continuum::Layout(p)).pieces.empty()) << "open on one side";
  p = bunker();
  p.vessel[3] = plate("lower right", {1.9, 0, 1}, {1.3, 0, 2}, {0, 1.5, 0});
  const SiloShape uneven{continuum::Layout(p)};
  ASSERT_EQ(uneven.pieces.size(), 1u) << "the hopper's walls have two angles";
  EXPECT_FALSE(uneven.pieces[0].is_hopper());
}

}  // namespace
}  // namespace talus::app
