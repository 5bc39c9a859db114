// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/half_spheres.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "physics/granular/appendix_b.hpp"
#include "physics/granular/kinematics.hpp"

namespace talus::granular {
namespace {

const Tensor3<> given{0.01, 0.02, -0.03, 0.004, -0.02, 0.05, 0.02, -0.01, -0.03};

Vector3 product(const Tensor3<>& a, const Vector3& b) {
  return {a.xx * b.x + a.xy * b.y + a.xz * b.z, a.yx * b.x + a.yy * b.y + a.yz * b.z,
          a.zx * b.x + a.zy * b.y + a.zz * b.z};
}
/// Offsets of the particle itself and its six neighbours.
std::vector<Vector3> lattice() {
  return {{}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}
/// d = G X with X = (I + G)^-1 x, shifted as a whole.
HalfSpheres around(const std::vector<Vector3>& offsets) {
  const Tensor3<> back = inverse(full(isotropic(1.0)) + given);
  HalfSpheres halves;
  for (const Vector3& x : offsets) halves.add(x, product(given, product(back, x)) + Vector3{5, -7, 0.3});
  return halves;
}
void expect_given(const Tensor3<>& g, double tolerance) {
  EXPECT_NEAR(g.xx, given.xx, tolerance);
  EXPECT_NEAR(g.xy, given.xy, tolerance);
  EXPECT_NEAR(g.xz, given.xz, tolerance);
  EXPECT_NEAR(g.yx, given.yx, tolerance);
  EXPECT_NEAR(g.yy, given.yy, tolerance);
  EXPECT_NEAR(g.yz, given.yz, tolerance);
  EXPECT_NEAR(g.zx, given.zx, tolerance);
  EXPECT_NEAR(g.zy, given.zy, tolerance);
  EXPECT_NEAR(g.zz, given.zz, tolerance);
}

TEST(HalfSpheres, OfALatticeOverAReferenceThatIsStraightAreExact) {
  // X on the lattice, so that the halves are mirror images in X and, by the sign of their offsets, in x.
  HalfSpheres halves;
  for (const Vector3& X : lattice()) {
    const Vector3 along{X.x * (1 + given.xx), X.y * (1 + given.yy), X.z * (1 + given.zz)};
    halves.add(along, along - X);
  }
  const Tensor3<> g = halves.gradient();
  EXPECT_NEAR(g.xx, given.xx, 1e-15);
  EXPECT_NEAR(g.yy, given.yy, 1e-15);
  EXPECT_NEAR(g.zz, given.zz, 1e-15);
  EXPECT_NEAR(g.xz, 0, 1e-15);
  EXPECT_NEAR(almansi_strain(g).zz, (1 / (0.97 * 0.97) - 1) / 2, 1e-12);
}

TEST(HalfSpheres, OfALatticeSeeEveryComponentToFirstOrder) {
  // x on the lattice, X not quite: the false part is the product of two components of the gradient.
  expect_given(around(lattice()).gradient(), 0.05 * 0.05);
}

TEST(HalfSpheres, DoNotSeeAShiftOfAll) {
  HalfSpheres halves;
  for (const Vector3& x : lattice()) halves.add(x, {5, -7, 0.25});
  EXPECT_EQ(halves.gradient(), Tensor3<>{});
}

TEST(HalfSpheres, TakeALopsidedNeighbourhoodForShear) {
  // One particle half way up before the plane and one half way down behind it: a squash along z, which leaves x alone,
  // seems to tilt the sides. The paper's method; a corrected gradient (velocity_gradient.hpp of SPH) does not do so.
  HalfSpheres halves;
  for (const Vector3& X : {Vector3{1, 0, 0.5}, Vector3{-1, 0, -0.5}, Vector3{0, 0, 1}, Vector3{0, 0, -1}}) {
    const Vector3 d{0, 0, -0.01 * X.z};
    halves.add(X + d, d);
  }
  EXPECT_NEAR(halves.gradient().zz, -0.01, 1e-15);
  EXPECT_NEAR(halves.gradient().zx, -0.005, 1e-15);
}

TEST(HalfSpheres, KnowNothingAlongAnAxisWithoutParticlesOnBothSides) {
  HalfSpheres halves;  // nothing below, not even itself
  for (const Vector3& x : {Vector3{1, 0, 0.2}, Vector3{-1, 0, 0.2}, Vector3{0, 0, 1}}) halves.add(x, {0.1 * x.x, 0, 9});
  const Tensor3<> g = halves.gradient();
  EXPECT_EQ(g.zz, 0);
  EXPECT_NEAR(g.xx, 0.1 / 0.9, 1e-15);
  EXPECT_EQ(HalfSpheres().gradient(), Tensor3<>{});
}

}  // namespace
}  // namespace talus::granular
