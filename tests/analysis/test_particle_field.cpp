// SPDX-License-Identifier: Apache-2.0
#include "analysis/particle_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/particles.hpp"

namespace talus {
namespace {

using test::box;
using test::lattice;

constexpr double h = 1e-2;

TEST(ParticleField, DepositsTheLatticesPackingUpToTheWalls) {
  const auto points = lattice(0.1, 0.03, 0, 0.1, h);
  const ParticleField field(test::particles(points, h), box(0.1, 0.03, 0.2));
  // The kernel's sum over a lattice is 1 to 2 % wherever one looks; corners, with images of images, are no exception.
  for (const Vector3& x : {Vector3{0.05, 0.015, 0.05},
                           {0.055, 0.015, 0.055},
                           {0, 0, 0},
                           {0.1, 0.03, 0.003},
                           {0.001, 0.002, 0.05},
                           {0.033, 0.0, 0.017}})
    EXPECT_NEAR(field.packing(x), 0.6, 0.012) << x.x << " " << x.y << " " << x.z;
  EXPECT_NEAR(field.packing({0.05, 0.015, 0.1}), 0.3, 0.006) << "half of it on the surface";
  EXPECT_EQ(field.packing({0.05, 0.015, 0.12}), 0);
}

TEST(ParticleField, InterpolatesLinearFields) {
  const auto points = lattice(0.1, 0.05, 0, 0.1, h);
  const ParticleField field(test::particles(points, h), box(0.1, 0.05, 0.2));
  std::vector<double> constant(points.size(), 7.5), stress;
  for (const Vector3& x : points) stress.push_back(1200 * (1 - x.z / 0.1) + 300 * x.x / 0.1);
  EXPECT_NEAR(field.value({0.0431, 0.021, 0.0387}, constant), 7.5, 1e-12);
  const auto exact = [](const Vector3& x) { return 1200 * (1 - x.z / 0.1) + 300 * x.x / 0.1; };
  // On a particle and between eight of them the sum is symmetric; elsewhere it errs by a few hundredths of a spacing.
  for (const Vector3& x : {Vector3{0.045, 0.025, 0.055}, {0.05, 0.03, 0.05}})
    EXPECT_NEAR(field.value(x, stress), exact(x), 1e-9);
  EXPECT_NEAR(field.value({0.0473, 0.0262, 0.0512}, stress), exact({0.0473, 0.0262, 0.0512}), 0.03 * 120);
  EXPECT_TRUE(std::isnan(field.value({0.05, 0.025, 0.15}, stress)));
}

TEST(ParticleField, TurnsVectorsOfImages) {
  const auto points = lattice(0.1, 0.05, 0, 0.1, h);
  const ParticleField field(test::particles(points, h), box(0.1, 0.05, 0.2));
  const std::vector<Vector3> velocity(points.size(), Vector3{1, 2, 3});
  const Vector3 at_left = field.value({0, 0.025, 0.055}, velocity);
  EXPECT_NEAR(at_left.x, 0, 1e-12);
  EXPECT_NEAR(at_left.y, 2, 1e-12);
  EXPECT_NEAR(at_left.z, 3, 1e-12);
}

TEST(ParticleField, GradientsAreExactForLinearVelocities) {
  auto points = lattice(0.1, 0.05, 0, 0.1, h);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].x += 2e-3 * std::sin(double(i));  // no lattice
  // y and z only where mirrors agree with the field: away from them
  const ParticleField field(test::particles(points, h), box(0.1, 0.05, 0.2));
  std::vector<Vector3> velocity;
  for (const Vector3& x : points) velocity.push_back({2 * x.x - 3 * x.z, 0.5 * x.x + x.y, 4 * x.x - x.y + 6 * x.z});
  std::size_t inner = 0;
  while (std::abs(points[inner].x - 0.05) > 0.01 || points[inner].y != 0.025 || points[inner].z != 0.055) ++inner;
  const std::vector<std::uint32_t> taken{static_cast<std::uint32_t>(inner)};
  const Tensor3<> l = velocity_gradients(field.particles(), field.domain(), taken, velocity).front();
  const Tensor3<> exact{2, 0, -3, 0.5, 1, 0, 4, -1, 6};
  for (const auto& [found, true_value] : {std::pair{l.xx, exact.xx},
                                          {l.xy, exact.xy},
                                          {l.xz, exact.xz},
                                          {l.yx, exact.yx},
                                          {l.yy, exact.yy},
                                          {l.yz, exact.yz},
                                          {l.zx, exact.zx},
                                          {l.zy, exact.zy},
                                          {l.zz, exact.zz}})
    EXPECT_NEAR(found, true_value, 1e-11);
}

TEST(ParticleField, SeesThroughOpenGatesOnly) {
  const auto points = lattice(0.1, 0.03, 0, 0.1, h);  // below the plate
  Domain domain = box(0.1, 0.03, 0.3, {test::plate(0.1, 0.1, 0.03, 0.07)});
  const ParticleField shut(test::particles(points, h), domain);
  EXPECT_EQ(shut.packing({0.05, 0.015, 0.105}), 0);
  EXPECT_NEAR(shut.packing({0.05, 0.015, 0.0999}), 0.6, 0.012) << "a plate mirrors";
  domain.open_gates();
  const ParticleField open(test::particles(points, h), domain);
  EXPECT_GT(open.packing({0.05, 0.015, 0.105}), 0.05);
  EXPECT_NEAR(open.packing({0.05, 0.015, 0.0999}), 0.3, 0.012);
  EXPECT_EQ(open.packing({0.01, 0.015, 0.105}), 0);
}

/// The gradient at a particle of a lattice, summed over all particles and images.
Tensor3<> gradient_at(std::size_t i, const std::vector<Vector3>& points, const std::vector<Vector3>& velocity,
                      const Domain& domain) {
  std::vector<Image> images = domain.images(sph::support * h);
  images.emplace_back();
  sph::GradientSums<> sums;
  for (const Image& image : images)
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vector3 place = image.position(points[j]), d = place - points[i];
      if (norm(d) < sph::support * h && domain.is_visible(points[i], place, image))
        sums.add(h * h * h, sph::cubic_spline_slope(norm(d), h), d, image.vector(velocity[j]) - velocity[i]);
    }
  return sph::velocity_gradient(sums);
}

TEST(VelocityGradients, AreSumsOverAllParticlesAndImages) {
  auto points = lattice(0.1, 0.02, 0, 0.15, h);  // thin: images of images
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = points[i] + 4e-3 * Vector3{std::sin(double(i)), std::cos(3.0 * double(i)), std::sin(5.0 * double(i))};
  std::vector<Vector3> velocity;
  for (const Vector3& x : points) velocity.push_back({x.z, x.x * x.x, -x.y + x.z});
  std::vector<std::uint32_t> taken;
  for (std::uint32_t i = 3; i < points.size(); i += 5) taken.push_back(i);
  Box periodic = box(0.1, 0.02, 0.3).box();
  periodic.faces[0] = periodic.faces[1] = FaceKind::periodic;
  for (const Domain& domain : {box(0.1, 0.02, 0.3), box(0.1, 0.02, 0.3, {test::plate(0.1, 0.08, 0.03, 0.07)}),
                               box(0.1, 0.02, 0.3, {Wall("slope", {0, 0, 0.05}, {0.06, 0, 0.11})}), Domain(periodic)}) {
    const auto gradients = velocity_gradients(test::particles(points, h), domain, taken, velocity);
    ASSERT_EQ(gradients.size(), taken.size());
    for (std::size_t n = 0; n < taken.size(); ++n) {
      const Tensor3<> a = gradients[n], b = gradient_at(taken[n], points, velocity, domain);
      const double difference = std::abs(a.xx - b.xx) + std::abs(a.xy - b.xy) + std::abs(a.xz - b.xz) +
                                std::abs(a.yx - b.yx) + std::abs(a.yy - b.yy) + std::abs(a.yz - b.yz) +
                                std::abs(a.zx - b.zx) + std::abs(a.zy - b.zy) + std::abs(a.zz - b.zz);
      ASSERT_LT(difference, 1e-12) << n;
    }
  }
  EXPECT_EQ(ParticleField({}, box(1, 1, 1)).packing({0.5, 0.5, 0.5}), 0);
}

TEST(ParticleField, ParticlesOfADensity) {
  const std::vector<Vector3> points = {{0, 0, 0}, {1, 0, 0}};
  const Particles particles = particles_of_density(points, std::vector<double>{1500, 12}, 12e-3, 2500);
  EXPECT_DOUBLE_EQ(particles.volume[0], 8e-6);
  EXPECT_DOUBLE_EQ(particles.smoothing_length[0], 0.02);
  EXPECT_DOUBLE_EQ(particles.smoothing_length[1], 0.1);
  EXPECT_DOUBLE_EQ(particles.solid_volume, 4.8e-6);
  EXPECT_DOUBLE_EQ(particles_of_density(points, std::vector<double>{1500, 12}, 12e-3, 2500, 0.03).smoothing_length[1],
                   0.03);
  Particles without_extent = particles;
  without_extent.smoothing_length[0] = 0;
  EXPECT_THROW(ParticleField(without_extent, box(1, 1, 1)), std::invalid_argument);
}

TEST(ParticleField, TheParticlesAroundAPlaceAreEnoughThere) {
  const auto points = lattice(0.1, 0.03, 0, 0.1, h);
  const Vector3 place{0.043, 0.011, 0.052};
  const ParticleField all(test::particles(points, h), box(0.1, 0.03, 0.2));
  std::vector<Vector3> near;
  for (const std::size_t i : particles_around(points, place, 2 * h)) near.push_back(points[i]);
  EXPECT_LT(near.size(), points.size() / 4);
  EXPECT_DOUBLE_EQ(ParticleField(test::particles(near, h), box(0.1, 0.03, 0.2)).packing(place), all.packing(place));
}

}  // namespace
}  // namespace talus
