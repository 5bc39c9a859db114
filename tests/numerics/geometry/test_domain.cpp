// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/domain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "base/random.hpp"

namespace talus {
namespace {

using enum FaceKind;

Wall plate(const Box& box, double height, std::vector<Wall::Opening> openings = {}) {
  return {"plate", {box.low.x, 0, height}, {box.high.x, 0, height}, std::move(openings)};
}

/// The hopper's domain in units of millimetres: a plate at 100 with a slit from 30 to 70.
Domain hopper(bool shut = false) {
  const Box box{{0, 0, 0}, {100, 5, 250}, {wall, wall, symmetry, symmetry, wall, open}};
  return Domain(box, {plate(box, 100, {{30, 70, shut}})});
}

std::vector<Vector3> images_of(const Domain& domain, const Vector3& x, double reach) {
  std::vector<Vector3> found;
  for (const Image& image : domain.images(reach))
    if (domain.is_near(image, image.position(x), reach)) found.push_back(image.position(x));
  return found;
}

TEST(Images, OfAParticleInTheMiddleOfALargeBoxThereAreNone) {
  const Box box{{0, 0, 0}, {10, 10, 10}, {wall, wall, wall, wall, wall, wall}};
  EXPECT_TRUE(images_of(Domain(box), {5, 5, 5}, 2).empty());
}

TEST(Images, ACornerMakesSeven) {
  const Box box{{0, 0, 0}, {10, 10, 10}, {wall, wall, symmetry, symmetry, wall, wall}};
  const auto found = images_of(Domain(box), {1, 2, 9}, 3);
  EXPECT_THAT(found,
              testing::UnorderedElementsAre(Vector3{-1, 2, 9}, Vector3{1, -2, 9}, Vector3{1, 2, 11}, Vector3{-1, -2, 9},
                                            Vector3{-1, 2, 11}, Vector3{1, -2, 11}, Vector3{-1, -2, 11}));
}

TEST(Images, InAThinBoxAParticleMeetsAllImagesOfItselfWithinReach) {
  // Mirrors at 0 and 1: images of 0.3 are 2k - 0.3 and 2k + 0.3.
  const Box mirrors{{0, 0, 0}, {100, 1, 100}, {open, open, wall, symmetry, open, open}};
  std::multiset<double> found;
  for (const Vector3& x : images_of(Domain(mirrors), {50, 0.3, 50}, 2.5)) found.insert(x.y);
  EXPECT_THAT(found, testing::ElementsAre(testing::DoubleEq(-2.3), testing::DoubleEq(-1.7), testing::DoubleEq(-0.3),
                                          testing::DoubleEq(1.7), testing::DoubleEq(2.3)));
  const Box periodic_box{{0, 0, 0}, {100, 1, 100}, {open, open, periodic, periodic, open, open}};
  found.clear();
  for (const Vector3& x : images_of(Domain(periodic_box), {50, 0.3, 50}, 2.5)) found.insert(x.y);
  EXPECT_THAT(found, testing::ElementsAre(testing::DoubleEq(-1.7), testing::DoubleEq(-0.7), testing::DoubleEq(1.3),
                                          testing::DoubleEq(2.3), testing::DoubleEq(3.3)));
}

TEST(Images, OfOneMirrorOppositeAnOpenFaceThereIsOne) {
  const Box box{{0, 0, 0}, {100, 1, 100}, {open, open, wall, open, open, open}};
  EXPECT_THAT(images_of(Domain(box), {50, 0.3, 50}, 5), testing::ElementsAre(Vector3{50, -0.3, 50}));
}

TEST(Images, ReverseTheNormalVelocityExceptAtPrintedFaces) {
  const Box box{{0, 0, 0}, {10, 3, 10}, {wall, periodic, printed, symmetry, open, open}};
  EXPECT_THROW(Domain{box}, std::invalid_argument);
  const Box valid{{0, 0, 0}, {10, 3, 10}, {wall, wall, printed, symmetry, open, open}};
  for (const Image& image : Domain(valid).images(4)) {
    const Vector3 v = image.vector({1, 1, 1});
    EXPECT_EQ(v.x, image.copy[0] == 0 ? 1 : -1);
    // Copy 1 is mirrored at the symmetry face, -1 at the printed one, 2 and -2 once at each.
    EXPECT_EQ(v.y, (image.copy[1] == 1 || std::abs(image.copy[1]) == 2) ? -1 : 1) << int(image.copy[1]);
    EXPECT_EQ(v.z, 1);
    for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(image.side[a], image.copy[a] < 0 ? -1 : image.copy[a] > 0 ? 1 : 0);
  }
}

TEST(Images, APlateMirrorsToBothSidesAndWithTheWalls) {
  const auto found = images_of(hopper(), {1, 2.5, 102}, 3);
  // Side wall, front and rear, plate, and their products.
  EXPECT_EQ(found.size(), 2u * 3u * 2u - 1u);
  EXPECT_THAT(found, testing::Contains(Vector3{1, 2.5, 98}));
  EXPECT_THAT(found, testing::Contains(Vector3{-1, 7.5, 98}));
}

bool is_visible(const Domain& domain, const Vector3& from, const Vector3& to) {
  return domain.is_visible(from, to, Image{});
}
/// The image in the plate that stands at `to`.
bool sees_in_plate(const Domain& domain, const Vector3& from, const Vector3& to) {
  const std::vector<Image> images = domain.images(3);
  return domain.is_visible(from, to, *std::find_if(images.begin(), images.end(), [](const Image& image) {
                             return image.is_in_walls() && image.copy == std::array<std::int8_t, 3>{};
                           }));
}

TEST(Sees, ThroughTheSlitButNotThroughThePlate) {
  const Domain domain = hopper();
  EXPECT_TRUE(is_visible(domain, {50, 2, 101}, {51, 2, 99}));
  EXPECT_FALSE(is_visible(domain, {20, 2, 101}, {21, 2, 99}));
  EXPECT_TRUE(is_visible(domain, {20, 2, 101}, {21, 2, 101.5}));
  Domain shut = hopper(true);
  EXPECT_FALSE(is_visible(shut, {50, 2, 101}, {51, 2, 99}));
  EXPECT_TRUE(shut.has_gates_due(0));
  shut.open_gates(0);
  EXPECT_FALSE(shut.has_gates_due(0));
  EXPECT_TRUE(is_visible(shut, {50, 2, 101}, {51, 2, 99}));
  // At the edge it is where the line between the two passes the plane that counts.
  EXPECT_TRUE(is_visible(domain, {29.5, 2, 101}, {30.7, 2, 99}));
  EXPECT_FALSE(is_visible(domain, {29.5, 2, 101}, {30.4, 2, 99}));
  // Beyond a side wall the plate goes on.
  EXPECT_FALSE(is_visible(domain, {1, 2, 101}, {-1, 2, 99}));
}

TEST(Sees, AnImageInThePlateWhereThePlateIs) {
  const Domain domain = hopper();
  EXPECT_TRUE(sees_in_plate(domain, {20, 2, 101}, {20, 2, 99}));    // its own image
  EXPECT_FALSE(sees_in_plate(domain, {50, 2, 101}, {50, 2, 99}));   // over the slit there is no mirror
  EXPECT_FALSE(sees_in_plate(domain, {20, 2, 99}, {20, 2, 99.5}));  // an image of the other side
  EXPECT_TRUE(sees_in_plate(domain, {1, 2, 101}, {-1, 2, 99}));     // mirrored by side wall and plate
}

TEST(Sees, EveryNeighbourEitherItselfOrItsImageAndAlikeFromBothEnds) {
  // Between two points on one side the image counts where the line to it meets the plate; between two on opposite
  // sides the points themselves where the line misses it. Mirror images are seen alike from both ends.
  const Domain domain = hopper();
  Random random(5);
  int through = 0, mirrored = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vector3 a{random.uniform(20, 40), random.uniform(0, 5), random.uniform(97, 103)};
    const Vector3 b{random.uniform(20, 40), random.uniform(0, 5), random.uniform(97, 103)};
    const Vector3 image_a{a.x, a.y, 200 - a.z}, image_b{b.x, b.y, 200 - b.z};
    EXPECT_EQ(is_visible(domain, a, b), is_visible(domain, b, a));
    EXPECT_EQ(sees_in_plate(domain, a, image_b), sees_in_plate(domain, b, image_a));
    const bool same_side = (a.z > 100) == (b.z > 100);
    if (same_side) {
      EXPECT_TRUE(is_visible(domain, a, b));
      mirrored += sees_in_plate(domain, a, image_b);
    } else {
      EXPECT_FALSE(sees_in_plate(domain, a, image_b));
      through += is_visible(domain, a, b);
    }
  }
  EXPECT_GT(through, 2000);
  EXPECT_GT(mirrored, 2000);
}

TEST(Sees, WhatIsCertainWhereverBothStayNear) {
  Random random(7);
  constexpr double margin = 0.5, reach = 4;
  int always = 0, never = 0, may_change = 0;
  for (const bool shut : {false, true}) {
    const Domain domain = hopper(shut);
    Domain open = domain;
    open.open_gates();
    std::vector<Image> images = domain.images(reach);
    images.push_back({});
    for (int n = 0; n < 20000; ++n) {
      const Vector3 from{random.uniform(0, 100), random.uniform(0, 5), random.uniform(97, 103)};
      const Image& image = images[static_cast<std::size_t>(random.uniform(0, static_cast<double>(images.size())))];
      const auto move = [&] { return Vector3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
      const Vector3 source = domain.fold(from + reach * move()), to = image.position(source);
      if (norm(to - from) > reach) continue;
      const Domain::Visibility visibility = domain.visibility(from, to, image, margin);
      always += visibility == Domain::Visibility::always;
      never += visibility == Domain::Visibility::never;
      may_change += visibility == Domain::Visibility::may_change;
      if (visibility == Domain::Visibility::may_change) continue;
      for (int k = 0; k < 20; ++k) {
        const Vector3 near_from = domain.fold(from + (margin / 2) * move());
        const Vector3 near_to = image.position(domain.fold(source + (margin / 2) * move()));
        for (const Domain* now : std::initializer_list<const Domain*>{&domain, &open})
          EXPECT_EQ(now->is_visible(near_from, near_to, image), visibility == Domain::Visibility::always);
      }
    }
  }
  EXPECT_GT(always, 300);
  EXPECT_GT(never, 300);
  EXPECT_GT(may_change, 300);
}

TEST(Sees, InTheMiddleOfAnOpenSlitNobodyIsInDoubt) {
  constexpr double margin = 0.5;
  const Domain shut = hopper(true), open = hopper(false);
  const Vector3 in_the_slit{50, 2, 100.1}, below{51, 2, 98}, at_the_rim{30.2, 2, 100.1};
  EXPECT_EQ(open.visibility(in_the_slit, below, {}, margin), Domain::Visibility::always);
  EXPECT_EQ(shut.visibility(in_the_slit, below, {}, margin), Domain::Visibility::may_change);
  EXPECT_EQ(open.visibility(at_the_rim, below, {}, margin), Domain::Visibility::may_change);
}

TEST(Sees, AWallAcrossTheBoxIsTheSameAsALayerAndFollowed) {
  // Whether the way to an image is followed or read off the place where it meets the plate: the same images are seen.
  const Box box{{0, 0, 0}, {100, 5, 250}, {wall, wall, symmetry, symmetry, wall, wall}};
  const Wall slit = plate(box, 100, {{30, 70}});
  const Domain layered(box, {slit}), followed(box, {slit}, 101);
  ASSERT_EQ(layered.max_reach(), 100);
  ASSERT_NE(followed.max_reach(), 100);
  constexpr double reach = 8;
  const auto seen = [&](const Domain& domain, const Vector3& own, const Vector3& source) {
    std::vector<std::array<double, 3>> places;
    for (const Image& image : domain.images(reach)) {
      const Vector3 x = image.position(source);
      if (domain.is_near(image, x, reach) && norm(x - own) < reach && domain.is_visible(own, x, image))
        places.push_back({std::round(x.x * 1e6), std::round(x.y * 1e6), std::round(x.z * 1e6)});
    }
    if (domain.is_visible(own, source, Image{})) places.push_back({});
    std::sort(places.begin(), places.end());
    return places;
  };
  Random random(4);
  std::size_t most = 0;
  for (int n = 0; n < 4000; ++n) {
    const double x = n % 2 == 0 ? random.uniform(0, 8) : random.uniform(25, 35);
    const Vector3 own{x, random.uniform(0, 5), random.uniform(94, 106)};
    const Vector3 source{std::abs(x + random.uniform(-4, 4)), random.uniform(0, 5), random.uniform(94, 106)};
    const auto places = seen(layered, own, source);
    ASSERT_EQ(places, seen(followed, own, source)) << own.x << ' ' << own.z << " to " << source.x << ' ' << source.z;
    most = std::max(most, places.size());
    const auto end = layered.end_of_line(own, source), same = followed.end_of_line(own, source);
    ASSERT_TRUE(end && same);
    EXPECT_NEAR(end->x, same->x, 1e-9);
    EXPECT_NEAR(end->z, same->z, 1e-9);
    const auto bounce = layered.bounce(own, source), other = followed.bounce(own, source);
    ASSERT_EQ(bounce.has_value(), other.has_value());
    if (bounce) {
      EXPECT_EQ(bounce->image.position(source), other->image.position(source));
    }
  }
  EXPECT_GT(most, 5u);
}

TEST(Loads, OfAnImageGoToTheBoundariesThatMakeIt) {
  const Domain domain = hopper();
  for (const Image& image : domain.images(3)) {
    std::vector<int> expected, found;
    for (int axis = 0; axis < 3; ++axis)
      if (const int side = image.side[static_cast<std::size_t>(axis)]) expected.push_back(face_number(axis, side > 0));
    if (image.is_in_walls()) expected.push_back(wall_number(0));
    for (const Domain::Load& load : domain.loads(image)) {
      if (load.wall < 0) break;
      found.push_back(load.wall);
      EXPECT_EQ(load.part, domain.normal(load.wall));
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(Bounce, ReflectsAtWallsAndAtThePlateButNotInTheSlit) {
  const Domain domain = hopper();
  EXPECT_FALSE(domain.bounce({50, 2, 101}, {50, 2, 99}));
  EXPECT_FALSE(domain.bounce({20, 2, 101}, {20, 2, 100.5}));
  const auto at_plate = domain.bounce({20, 2, 100.1}, {20.5, 2, 99.8});
  ASSERT_TRUE(at_plate);
  EXPECT_EQ(at_plate->wall, wall_number(0));
  EXPECT_EQ(at_plate->image.position({20.5, 2, 99.8}), (Vector3{20.5, 2, 100.2}));
  EXPECT_EQ(at_plate->image.vector({1, 2, -3}), (Vector3{1, 2, 3}));
  const auto from_below = domain.bounce({20, 2, 99.9}, {20, 2, 100});
  ASSERT_TRUE(from_below);
  const auto at_wall = domain.bounce({99.9, 2, 20}, {100.25, 2, 20});
  ASSERT_TRUE(at_wall);
  EXPECT_EQ(at_wall->wall, face_number(0, 1));
  EXPECT_EQ(at_wall->image.position({100.25, 2, 20}), (Vector3{99.75, 2, 20}));
  EXPECT_FALSE(domain.bounce({50, 2, 249}, {50, 2, 251}));  // open
}

TEST(Domain, FoldsIntoTheBoxAndWrapsPeriodicFaces) {
  const Box box{{0, 0, 0}, {10, 1, 10}, {wall, wall, symmetry, symmetry, periodic, periodic}};
  const Domain domain(box);
  const Vector3 folded = domain.fold({-1, 3.3, 12});
  EXPECT_DOUBLE_EQ(folded.x, 1);
  EXPECT_NEAR(folded.y, 0.7, 1e-14);
  EXPECT_DOUBLE_EQ(folded.z, 2);
  EXPECT_EQ(domain.wrap({-1, 3.3, -0.5}), (Vector3{-1, 3.3, 9.5}));
}

TEST(Domain, KnowsHowFarItsImagesReach) {
  EXPECT_EQ(hopper().max_reach(), 100);
  const Box box{{0, 0, 0}, {100, 5, 250}, {wall, wall, symmetry, symmetry, wall, open}};
  const Domain two(box, {plate(box, 100), plate(box, 110)});
  EXPECT_EQ(two.max_reach(), 10);
  // Walls that are no layers are followed, however near.
  constexpr double endless = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Domain(box, {plate(box, 100), plate(box, 110)}, 11).max_reach(), endless);
  EXPECT_EQ(Domain(box, {plate(box, 300)}).max_reach(), endless);
  EXPECT_EQ(Domain(box, {plate(box, 100), Wall("upright", {50, 0, 0}, {50, 0, 250})}).max_reach(), endless);
  EXPECT_EQ(Domain(box, {Wall("short", {0, 0, 100}, {99, 0, 100})}).max_reach(), endless);
  EXPECT_EQ(Domain(box, {Wall("to the open top", {50, 0, 0}, {50, 0, 250})}).max_reach(), endless);
}

}  // namespace
}  // namespace talus
