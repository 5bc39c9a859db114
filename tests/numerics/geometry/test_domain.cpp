// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/domain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "base/random.hpp"

namespace talus {
namespace {

using enum FaceKind;

/// The hopper's domain in units of millimetres: a plate at 100 with a slit from 30 to 70.
Domain hopper(bool shut = false) {
  const Box box{{0, 0, 0}, {100, 5, 250}, {wall, wall, symmetry, symmetry, wall, open}};
  return {box, {{.axis = 2, .position = 100, .openings = {{{30, -1, 0}, {70, 6, 0}, shut}}}}};
}

std::vector<Vector3> images_of(const Domain& domain, const Vector3& x, double reach) {
  std::vector<Vector3> found;
  for (const Image& image : domain.images(reach))
    if (domain.is_near(image, image.position(x), reach)) found.push_back(image.position(x));
  return found;
}

TEST(Images, OfAParticleInTheMiddleOfALargeBoxThereAreNone) {
  const Box box{{0, 0, 0}, {10, 10, 10}, {wall, wall, wall, wall, wall, wall}};
  EXPECT_TRUE(images_of(Domain(box, {}), {5, 5, 5}, 2).empty());
}

TEST(Images, ACornerMakesSeven) {
  const Box box{{0, 0, 0}, {10, 10, 10}, {wall, wall, symmetry, symmetry, wall, wall}};
  const auto found = images_of(Domain(box, {}), {1, 2, 9}, 3);
  EXPECT_THAT(found,
              testing::UnorderedElementsAre(Vector3{-1, 2, 9}, Vector3{1, -2, 9}, Vector3{1, 2, 11}, Vector3{-1, -2, 9},
                                            Vector3{-1, 2, 11}, Vector3{1, -2, 11}, Vector3{-1, -2, 11}));
}

TEST(Images, InAThinBoxAParticleMeetsAllImagesOfItselfWithinReach) {
  // Mirrors at 0 and 1: images of 0.3 are 2k - 0.3 and 2k + 0.3.
  const Box mirrors{{0, 0, 0}, {100, 1, 100}, {open, open, wall, symmetry, open, open}};
  std::multiset<double> found;
  for (const Vector3& x : images_of(Domain(mirrors, {}), {50, 0.3, 50}, 2.5)) found.insert(x.y);
  EXPECT_THAT(found, testing::ElementsAre(testing::DoubleEq(-2.3), testing::DoubleEq(-1.7), testing::DoubleEq(-0.3),
                                          testing::DoubleEq(1.7), testing::DoubleEq(2.3)));
  const Box periodic_box{{0, 0, 0}, {100, 1, 100}, {open, open, periodic, periodic, open, open}};
  found.clear();
  for (const Vector3& x : images_of(Domain(periodic_box, {}), {50, 0.3, 50}, 2.5)) found.insert(x.y);
  EXPECT_THAT(found, testing::ElementsAre(testing::DoubleEq(-1.7), testing::DoubleEq(-0.7), testing::DoubleEq(1.3),
                                          testing::DoubleEq(2.3), testing::DoubleEq(3.3)));
}

TEST(Images, OfOneMirrorOppositeAnOpenFaceThereIsOne) {
  const Box box{{0, 0, 0}, {100, 1, 100}, {open, open, wall, open, open, open}};
  EXPECT_THAT(images_of(Domain(box, {}), {50, 0.3, 50}, 5), testing::ElementsAre(Vector3{50, -0.3, 50}));
}

TEST(Images, ReverseTheNormalVelocityExceptAtPrintedFaces) {
  const Box box{{0, 0, 0}, {10, 3, 10}, {wall, periodic, printed, symmetry, open, open}};
  EXPECT_THROW(Domain(box, {}), std::invalid_argument);
  const Box valid{{0, 0, 0}, {10, 3, 10}, {wall, wall, printed, symmetry, open, open}};
  for (const Image& image : Domain(valid, {}).images(4)) {
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

TEST(Sees, ThroughTheSlitButNotThroughThePlate) {
  const Domain domain = hopper();
  EXPECT_TRUE(domain.sees({50, 2, 101}, {51, 2, 99}));
  EXPECT_FALSE(domain.sees({20, 2, 101}, {21, 2, 99}));
  EXPECT_TRUE(domain.sees({20, 2, 101}, {21, 2, 101.5}));
  Domain shut = hopper(true);
  EXPECT_FALSE(shut.sees({50, 2, 101}, {51, 2, 99}));
  EXPECT_TRUE(shut.has_gates_due(0));
  shut.open_gates(0);
  EXPECT_FALSE(shut.has_gates_due(0));
  EXPECT_TRUE(shut.sees({50, 2, 101}, {51, 2, 99}));
  // At the edge it is where the line between the two passes the plane that counts.
  EXPECT_TRUE(domain.sees({29.5, 2, 101}, {30.7, 2, 99}));
  EXPECT_FALSE(domain.sees({29.5, 2, 101}, {30.4, 2, 99}));
  // Beyond a side wall the plate goes on.
  EXPECT_FALSE(domain.sees({1, 2, 101}, {-1, 2, 99}));
}

TEST(Sees, AnImageInThePlateWhereThePlateIs) {
  const Domain domain = hopper();
  EXPECT_TRUE(domain.sees({20, 2, 101}, {20, 2, 99}, 0));    // its own image
  EXPECT_FALSE(domain.sees({50, 2, 101}, {50, 2, 99}, 0));   // over the slit there is no mirror
  EXPECT_FALSE(domain.sees({20, 2, 99}, {20, 2, 99.5}, 0));  // an image of the other side
  EXPECT_TRUE(domain.sees({1, 2, 101}, {-1, 2, 99}, 0));     // mirrored by side wall and plate
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
    EXPECT_EQ(domain.sees(a, b), domain.sees(b, a));
    EXPECT_EQ(domain.sees(a, image_b, 0), domain.sees(b, image_a, 0));
    const bool same_side = (a.z > 100) == (b.z > 100);
    if (same_side) {
      EXPECT_TRUE(domain.sees(a, b));
      mirrored += domain.sees(a, image_b, 0);
    } else {
      EXPECT_FALSE(domain.sees(a, image_b, 0));
      through += domain.sees(a, b);
    }
  }
  EXPECT_GT(through, 2000);
  EXPECT_GT(mirrored, 2000);
}

TEST(Bounce, ReflectsAtWallsAndAtThePlateButNotInTheSlit) {
  const Domain domain = hopper();
  EXPECT_FALSE(domain.bounce({50, 2, 101}, {50, 2, 99}));
  EXPECT_FALSE(domain.bounce({20, 2, 101}, {20, 2, 100.5}));
  const auto at_plate = domain.bounce({20, 2, 100.1}, {20.5, 2, 99.8});
  ASSERT_TRUE(at_plate);
  EXPECT_EQ(at_plate->wall, wall_of_plate(0));
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
  const Domain domain(box, {});
  const Vector3 folded = domain.fold({-1, 3.3, 12});
  EXPECT_DOUBLE_EQ(folded.x, 1);
  EXPECT_NEAR(folded.y, 0.7, 1e-14);
  EXPECT_DOUBLE_EQ(folded.z, 2);
  EXPECT_EQ(domain.wrap({-1, 3.3, -0.5}), (Vector3{-1, 3.3, 9.5}));
}

TEST(Domain, KnowsHowFarItsImagesReach) {
  EXPECT_EQ(hopper().largest_reach(), 100);
  const Box box{{0, 0, 0}, {100, 5, 250}, {wall, wall, symmetry, symmetry, wall, open}};
  const Domain two(box, {{.axis = 2, .position = 100, .openings = {}}, {.axis = 2, .position = 110, .openings = {}}});
  EXPECT_EQ(two.largest_reach(), 10);
  EXPECT_THROW(Domain(box, {{.axis = 2, .position = 300, .openings = {}}}), std::invalid_argument);
  EXPECT_THROW(Domain(box, {{.axis = 2, .position = 100, .openings = {}}, {.axis = 0, .position = 50, .openings = {}}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace talus
