// SPDX-License-Identifier: Apache-2.0
/// Walls at any angle: what blocks, who sees which image, and that nothing gets through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/random.hpp"
#include "base/unit.hpp"
#include "numerics/geometry/domain.hpp"

namespace talus {
namespace {

using enum FaceKind;

Box box_of(double width, double height, FaceKind side = wall) {
  return {{0, 0, 0}, {width, 5, height}, {side, side, symmetry, symmetry, wall, open}};
}

/// A wedge of half angle 30 degrees with an outlet of 20 at z = 50, in a box 100 wide.
Domain wedge(bool shut = false) {
  const double top = 50 + 40 / std::tan(30 * degree);
  return Domain(box_of(100, 250), {{"left", {40, 0, 50}, {0, 0, top}},
                                   {"right", {60, 0, 50}, {100, 0, top}},
                                   {"gate", {40, 0, 50}, {60, 0, 50}, {{-100, 200, shut}}}});
}

/// Two walls that meet at (50, 50), the one downwards, the other at that angle from it; the corner is to the right.
Domain corner(double angle) {
  return Domain(box_of(100, 100, open),
                {{"one", {50, 0, 50}, {50, 0, 0}},
                 {"other", {50, 0, 50}, {50 + 45 * std::sin(angle), 0, 50 - 45 * std::cos(angle)}}});
}

TEST(Wall, BlocksWhereItIsSolidAndAlikeFromBothEnds) {
  const Domain domain = wedge();
  EXPECT_TRUE(domain.blocks({30, 2, 60}, {40, 2, 70}));
  EXPECT_FALSE(domain.blocks({45, 2, 60}, {50, 2, 70}));
  EXPECT_FALSE(domain.blocks({50, 2, 45}, {50, 2, 55}));  // through the outlet
  EXPECT_FALSE(domain.blocks({38, 2, 48}, {42, 2, 49}));  // below it
  EXPECT_TRUE(wedge(true).blocks({50, 2, 45}, {50, 2, 55}));
  EXPECT_TRUE(domain.blocks({39.9, 2, 51}, {39.9, 2, 49}));
  Random random(3);
  int blocked = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vector3 a{random.uniform(0, 100), 2, random.uniform(0, 250)},
        b{random.uniform(0, 100), 3, random.uniform(0, 250)};
    EXPECT_EQ(domain.blocks(a, b), domain.blocks(b, a));
    blocked += domain.blocks(a, b);
  }
  EXPECT_GT(blocked, 2000);
}

TEST(Wall, OpensItsGatesAtTheirTimes) {
  Domain domain(box_of(100, 100), {{"one", {0, 0, 30}, {100, 0, 30}, {{40, 60, true, 0}}},
                                   {"two", {0, 0, 60}, {100, 0, 60}, {{40, 60, true, 0.2}, {70, 80, false}}}});
  EXPECT_TRUE(domain.blocks({50, 1, 29}, {50, 1, 31}));
  EXPECT_FALSE(domain.blocks({75, 1, 59}, {75, 1, 61}));
  EXPECT_TRUE(domain.has_gates_due(0.1));
  domain.open_gates(0.1);
  EXPECT_FALSE(domain.has_gates_due(0.1));
  EXPECT_TRUE(domain.has_gates_due(0.2));
  EXPECT_FALSE(domain.blocks({50, 1, 29}, {50, 1, 31}));
  EXPECT_TRUE(domain.blocks({30, 1, 29}, {30, 1, 31}));
  EXPECT_TRUE(domain.blocks({50, 1, 59}, {50, 1, 61}));
  domain.open_gates(0.2);
  EXPECT_FALSE(domain.has_gates_due(1));
  EXPECT_FALSE(domain.blocks({50, 1, 59}, {50, 1, 61}));
}

TEST(Wall, MirrorsPlacesVelocitiesAndStresses) {
  const Domain domain(box_of(100, 100, open), {{"slope", {0, 0, 50}, {50, 0, 0}}});
  const std::vector<Image> images = domain.images(1);
  const auto image =
      std::find_if(images.begin(), images.end(), [](const Image& i) { return i.is_in_walls() && i.copy[1] == 0; });
  ASSERT_NE(image, images.end());
  const Vector3 x = image->position({30, 2, 25});  // the line is x + z = 50
  EXPECT_NEAR(x.x, 25, 1e-12);
  EXPECT_EQ(x.y, 2);
  EXPECT_NEAR(x.z, 20, 1e-12);
  EXPECT_NEAR(norm(image->source(x) - Vector3{30, 2, 25}), 0, 1e-12);
  EXPECT_NEAR(norm(image->vector({1, 2, 3}) - Vector3{-3, 2, -1}), 0, 1e-14);
  const SymmetricTensor3<> t = image->tensor({1, 2, 3, 4, 5, 6});
  EXPECT_NEAR(t.xx, 3, 1e-14);
  EXPECT_NEAR(t.zz, 1, 1e-14);
  EXPECT_NEAR(t.yy, 2, 1e-14);
  EXPECT_NEAR(t.xy, -5, 1e-14);
  EXPECT_NEAR(t.yz, -4, 1e-14);
  EXPECT_NEAR(t.zx, 6, 1e-14);
}

/// Share of the places around that hold an image of some place in the domain, seen: of places that a mirrored world
/// shows without gap each holds one.
void expect_one_image_everywhere(double angle) {
  const Domain domain = corner(angle);
  constexpr double reach = 10;
  const std::vector<Image> images = domain.images(reach);
  Random random(7);
  int through_walls = 0;
  for (int n = 0; n < 4000; ++n) {
    // A particle in the corner, and a place anywhere near it.
    const double turn = angle * random.uniform(0.02, 0.98), r = random.uniform(0.5, 8);
    const Vector3 own{50 + r * std::sin(turn), 2, 50 - r * std::cos(turn)};
    const double direction = random.uniform(0, 2 * std::numbers::pi), far = random.uniform(0.1, reach);
    const Vector3 place{own.x + far * std::cos(direction), 2, own.z + far * std::sin(direction)};
    int held = !domain.blocks(own, place);
    through_walls += !held;
    for (const Image& image : images) {
      if (image.copy[1] != 0) continue;
      const Vector3 source = image.source(place);
      if (!domain.is_visible(own, place, image)) continue;
      ++held;
      EXPECT_TRUE(domain.is_near(image, place, reach));
      // The other way round: the source sees this particle's image, by the mirrors in opposite order.
      const bool seen_back = std::any_of(images.begin(), images.end(), [&](const Image& other) {
        const Vector3 x = other.position(own);
        return other.copy[1] == 0 && std::abs(norm(x - source) - far) < 1e-9 && domain.is_visible(source, x, other);
      });
      EXPECT_TRUE(seen_back);
    }
    EXPECT_EQ(held, 1) << angle / degree << " degrees, from " << own.x << ' ' << own.z << " to " << place.x << ' '
                       << place.z;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(through_walls, 500);
}

TEST(Walls, FillEveryCornerWithImagesOnce) {
  for (const double angle : {60.5, 75.0, 90.0, 110.0, 120.0, 150.0, 175.0, 240.0})
    expect_one_image_everywhere(angle * degree);
}

TEST(Walls, MeetTheFacesOfTheBox) {
  // Where the wedge meets the side wall, and where a chute ends at the right wall above the floor.
  const Domain domain = wedge();
  const double top = 50 + 40 / std::tan(30 * degree);
  const std::vector<Image> images = domain.images(6);
  Random random(9);
  int seen = 0;
  for (int n = 0; n < 5000; ++n) {
    const Vector3 own{random.uniform(0.1, 5), 2, top + random.uniform(0, 5)};
    const Vector3 place{own.x + random.uniform(-6, 6), 2, own.z + random.uniform(-6, 6)};
    if (norm(place - own) > 6) continue;
    int held = place.x > 0 && !domain.blocks(own, place);
    for (const Image& image : images)
      if (image.copy[1] == 0) held += domain.is_visible(own, place, image);
    EXPECT_EQ(held, 1);
    ++seen;
  }
  EXPECT_GT(seen, 2000);
}

TEST(Walls, HideTheirTwoSidesFromEachOther) {
  const Domain domain = wedge();
  const Vector3 inside{42, 2, 56}, outside{34, 2, 56};
  ASSERT_TRUE(domain.blocks(inside, outside));
  for (const Image& image : domain.images(12))
    EXPECT_FALSE(domain.is_near(image, image.position(outside), 12) &&
                 domain.is_visible(inside, image.position(outside), image));
  EXPECT_FALSE(domain.is_visible(inside, outside, Image{}));
}

TEST(Walls, TurnBackWhatWouldPassButNotInTheOutlet) {
  const Domain domain = wedge();
  EXPECT_FALSE(domain.bounce({50, 2, 51}, {50, 2, 49}));
  const Vector3 from{42, 2, 55}, to{36, 2, 54};
  const auto bounce = domain.bounce(from, to);
  ASSERT_TRUE(bounce);
  EXPECT_EQ(bounce->wall, wall_number(0));
  EXPECT_FALSE(domain.blocks(from, bounce->image.position(to)));
  // Momentum is taken along the normal alone.
  const Vector3 v{-1, 0.3, -2}, lost = v - bounce->image.vector(v);
  EXPECT_NEAR(norm(lost - dot(lost, domain.normal(6)) * domain.normal(6)), 0, 1e-14);
  EXPECT_NEAR(norm(bounce->image.vector(v)), norm(v), 1e-14);
}

TEST(Wall, IsGoneWhenAGateFromEndToEndHasOpened) {
  Wall wall("", {3, 0, 4}, {3, 0, 9}, {{.begin = 0, .end = 5, .shut = true}});
  EXPECT_FALSE(wall.is_gone());
  EXPECT_TRUE(wall.is_solid({3, 0, 4}));
  wall.open_gates(0);
  EXPECT_TRUE(wall.is_gone());
  for (const double z : {4.0, 6.0, 9.0}) EXPECT_FALSE(wall.is_solid({3, 0, z}));
  const Box box{{0, 0, 0}, {10, 5, 10}, {}};
  EXPECT_FALSE(Domain(box, {wall}).is_near_wall({3.1, 2, 6}, 1));
  EXPECT_FALSE(Wall("", {3, 0, 4}, {3, 0, 9}, {{.begin = 0, .end = 4.9}}).is_gone());
}

TEST(Wall, HasALengthAndItsOwnSidesWhereverItPoints) {
  EXPECT_THROW(Wall("", {1, 0, 1}, {1, 3, 1}), std::invalid_argument);
  for (const double turn : {0.0, 90.0, 180.0, 270.0, 30.0, 200.0}) {
    const Vector3 along{std::round(std::cos(turn * degree) * 1e12) / 1e12, 0,
                        std::round(std::sin(turn * degree) * 1e12) / 1e12};
    const Wall wall("", {3, 0, 4}, Vector3{3, 0, 4} + 5 * along, {{1, 2}});
    EXPECT_NEAR(wall.length(), 5, 1e-11);
    EXPECT_EQ(wall.axis(), turn == 0 || turn == 180 ? 2 : turn == 90 || turn == 270 ? 0 : -1);
    const auto at = [&](double s, double n) { return wall.from() + s * wall.direction() + n * wall.normal(); };
    EXPECT_NEAR(wall.above(at(2, 0.5)), 0.5, 1e-14);
    EXPECT_TRUE(wall.is_above(at(2, 0.5)) && !wall.is_above(at(2, -0.5)));
    EXPECT_NEAR(wall.distance(at(2, -0.5)), 0.5, 1e-14);
    EXPECT_NEAR(wall.distance(at(8, 4)), 5, 1e-11) << "beyond its end";
    EXPECT_TRUE(wall.is_solid(at(0.9, 0)) && !wall.is_solid(at(1.1, 1)) && !wall.is_solid(at(5.1, 0)));
    ASSERT_TRUE(wall.intersection(at(3, 1), at(3, -3)));
    EXPECT_NEAR(*wall.intersection(at(3, 1), at(3, -3)), 0.25, 1e-14);
    EXPECT_FALSE(wall.intersection(at(1.5, 1), at(1.5, -3)));
  }
}

}  // namespace
}  // namespace talus
