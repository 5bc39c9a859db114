// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/sector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/random.hpp"
#include "numerics/geometry/domain.hpp"

namespace talus {
namespace {

using enum FaceKind;

const Vector3 axis{50, 40, 0};

Domain sector_of_circle(int copies, FaceKind floor = open) {
  return Domain(Box{{0, 0, 0}, {100, 80, 100}, {open, open, open, open, floor, open}}, {}, 0, Sector(axis, copies));
}

Vector3 anywhere(Random& random) {
  return {random.uniform(20, 80), random.uniform(10, 70), random.uniform(0, 100)};
}

TEST(Sector, TurnsAreRotations) {
  for (const int copies : {4, 5, 18, 20, 72}) {
    const Sector sector(axis, copies);
    for (int k = -copies; k <= 2 * copies; ++k) {
      const double angle = 2 * std::numbers::pi * k / copies;
      const Tensor3<>& q = sector.turn(k);
      EXPECT_NEAR(q.xx, std::cos(angle), 1e-15 * (1 + std::abs(angle)));
      EXPECT_NEAR(q.yx, std::sin(angle), 1e-15 * (1 + std::abs(angle)));
      EXPECT_EQ(q.xx, q.yy);
      EXPECT_EQ(q.xy, -q.yx);
      EXPECT_EQ(q.zz, 1);
      EXPECT_NEAR(determinant(q), 1, 1e-15);
    }
  }
}

TEST(Sector, QuartersAreExact) {
  const Sector sector({0, 0, 0}, 20);
  EXPECT_EQ(sector.turned({3, 5, 7}, 5), (Vector3{-5, 3, 7}));
  EXPECT_EQ(sector.turned({3, 5, 7}, -5), (Vector3{5, -3, 7}));
  EXPECT_EQ(sector.turned({3, 5, 7}, 10), (Vector3{-3, -5, 7}));
}

TEST(Sector, EveryPlaceIsInOneCopy) {
  Random random(1);
  for (const int copies : {4, 7, 18}) {
    const Sector sector(axis, copies);
    for (int n = 0; n < 300; ++n) {
      const Vector3 x = anywhere(random);
      const int copy = sector.copy_at(x);
      EXPECT_EQ(sector.copy_at(sector.turned(x, -copy)), 0);
      EXPECT_EQ(sector.distance(sector.turned(x, -copy)), 0);
      for (int k = 0; k < copies; ++k) EXPECT_EQ(sector.copy_at(sector.turned(x, k)), (copy + k) % copies);
      EXPECT_NEAR(sector.radius(sector.turned(x, 3)), sector.radius(x), 1e-13 * 50);
    }
    EXPECT_EQ(sector.copy_at(axis), 0);
    EXPECT_EQ(sector.copy_at(axis + Vector3{7, 0, 0}), 0) << "a face belongs to what begins with it";
  }
  EXPECT_EQ(Sector({0, 0, 0}, 4).copy_at({0, 2, 0}), 1);
}

TEST(Sector, TheDistanceIsThatOfTheNearestPlace) {
  Random random(2);
  for (const int copies : {4, 18}) {
    const Sector sector(axis, copies);
    for (int n = 0; n < 100; ++n) {
      const Vector3 x = anywhere(random);
      double nearest = 1e9;
      for (const double azimuth : {0.0, 2 * std::numbers::pi / copies})
        for (double r = 0; r < 60; r += 0.01)
          nearest =
              std::min(nearest, std::hypot(x.x - axis.x - r * std::cos(azimuth), x.y - axis.y - r * std::sin(azimuth)));
      EXPECT_NEAR(sector.distance(x), sector.copy_at(x) == 0 ? 0 : nearest, 0.01);
    }
  }
}

TEST(Sector, FewerThanFourOrTooManyCopiesAreRefused) {
  EXPECT_THROW(Sector(axis, 3), std::invalid_argument);
  EXPECT_THROW(Sector(axis, 73), std::invalid_argument);
}

TEST(SectorOfADomain, ImagesAreTurnsAndThoseInTheFloorToo) {
  for (const FaceKind floor : {open, wall}) {
    const Domain domain = sector_of_circle(18, floor);
    const auto images = domain.images(5);
    EXPECT_EQ(images.size(), floor == open ? 17u : 35u);
    for (const Image& image : images) {
      EXPECT_FALSE(image.is_identity());
      EXPECT_EQ(std::abs(determinant(image.map)),
                image.copy[2] == 0 ? determinant(image.map) : -determinant(image.map));
      const Vector3 x{60, 41, 1}, y = image.position(x);
      EXPECT_NEAR(norm(y - domain.sector()->turned({x.x, x.y, image.copy[2] == 0 ? x.z : -x.z}, image.turns)), 0,
                  1e-13);
      EXPECT_NEAR(norm(image.source(y) - x), 0, 1e-13);
      const auto loads = domain.loads(image);
      EXPECT_EQ(loads[0].wall, image.copy[2] == 0 ? -1 : face_number(2, 0)) << "faces of a sector bear nothing";
    }
  }
}

TEST(SectorOfADomain, NoImageWithinReachIsMissed) {
  Random random(3);
  constexpr double reach = 4;
  const Domain domain = sector_of_circle(18);
  const auto images = domain.images(reach);
  for (int n = 0; n < 300; ++n) {
    Vector3 x = anywhere(random);
    x = domain.fold(x);
    EXPECT_EQ(domain.sector()->copy_at(x), 0);
    std::size_t near = 0, listed = 0;
    for (int k = 1; k < 18; ++k) near += domain.sector()->distance(domain.sector()->turned(x, k)) <= reach;
    for (const Image& image : images) listed += domain.is_near(image, image.position(x), reach);
    EXPECT_EQ(listed, near);
    EXPECT_EQ(near == 17, domain.sector()->radius(x) <= reach) << "only about the axis there are more than two";
  }
}

TEST(SectorOfADomain, WhatLeavesComesBackAsItWas) {
  const Domain domain = sector_of_circle(18);
  const Sector& sector = *domain.sector();
  const Vector3 inside = axis + Vector3{10, 0.1, 5}, outside = axis + Vector3{10, -0.1, 5};
  EXPECT_FALSE(domain.back_into_sector(inside));
  const auto image = domain.back_into_sector(outside);
  ASSERT_TRUE(image);
  EXPECT_EQ(sector.copy_at(image->position(outside)), 0);
  EXPECT_NEAR(norm(image->position(outside) - sector.turned(outside, 1)), 0, 1e-13);
  const Vector3 v{1, -2, 3};
  EXPECT_NEAR(norm(image->vector(v)), norm(v), 1e-15);
  const SymmetricTensor3<> t{1, 2, 3, 0.4, 0.5, 0.6}, turned = image->tensor(t);
  EXPECT_NEAR(trace(turned), trace(t), 1e-15);
  EXPECT_NEAR(norm(turned), norm(t), 1e-15);
  EXPECT_NEAR(determinant(full(turned)), determinant(full(t)), 1e-14);
  EXPECT_GT(std::abs(turned.xy - t.xy), 0.1) << "as the image has it";
}

TEST(SectorOfADomain, StandsAlone) {
  const Box box{{0, 0, 0}, {100, 80, 100}, {wall, wall, open, open, open, open}};
  EXPECT_THROW(Domain(box, {}, 0, Sector(axis, 18)), std::invalid_argument);
  EXPECT_FALSE(sector_of_circle(18).whole().sector());
  EXPECT_TRUE(sector_of_circle(18).whole().images(5).empty());
}

}  // namespace
}  // namespace talus
