// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/pair_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/evaluation.hpp"

namespace talus::continuum {
namespace {

void expect_gradient(const Tensor3<>& found, const Tensor3<>& exact, double tolerance) {
  const Tensor3<> d = found - exact;
  for (const double c : {d.xx, d.xy, d.xz, d.yx, d.yy, d.yz, d.zx, d.zy, d.zz}) EXPECT_NEAR(c, 0, tolerance);
}

TEST(PairSums, GradientsOfLinearFieldsAreExactAtFreeSurfacesAndBetweenDisturbedParticles) {
  Evaluation e(free_block(6, 5, 7));
  e.disturb(0.1);
  const Tensor3<> exact{1, -2, 0.5, 3, -1, 0.25, 0.75, 2, -0.5};
  e.velocity(linear(exact));
  e.evaluate();
  for (std::size_t i = 0; i < e.rates.velocity_gradient.size(); ++i)
    expect_gradient(e.rates.velocity_gradient[i], exact, 1e-10);
}

TEST(PairSums, GradientsOfLinearFieldsAreExactAtWallsEdgesCornersAndInThinBoxes) {
  for (const double depth : {1.0, 2.0, 5.0}) {
    Evaluation e(block_between_mirrors(depth));
    e.disturb(0.2);
    const Tensor3<> exact{1, 0, 0, 0, -2, 0, 0, 0, 3};
    e.velocity(linear(exact));
    e.evaluate();
    for (std::size_t i = 0; i < e.rates.velocity_gradient.size(); ++i)
      expect_gradient(e.rates.velocity_gradient[i], exact, 1e-11);
  }
}

TEST(PairSums, GradientsAreExactOnBothSidesOfAPlateAndAtItsEdges) {
  // Above the plate the particles stretch away from it, below they rest.
  Parameters p = column(20, 2, 30);
  p.plate.height = 15 * spacing;
  p.bed.bottom = 0;
  Evaluation e(p);
  e.disturb(0.2);
  const double height = 15 * spacing;
  e.velocity([&](const Vector3& x) { return x.z > height ? Vector3{0, 0, 2 * (x.z - height)} : Vector3{}; });
  e.evaluate();
  for (std::size_t i = 0; i < e.state.position.size(); ++i) {
    const bool above = e.state.position[i].z > height;
    if (e.state.position[i].z < 27 * spacing)  // the closed top does not stretch along
      expect_gradient(e.rates.velocity_gradient[i], above ? Tensor3<>{.zz = 2} : Tensor3<>{}, 1e-11);
  }
}

TEST(PairSums, UniformStressOnALatticeBetweenMirrorsPushesNothing) {
  for (const FaceKind kind : {FaceKind::wall, FaceKind::symmetry, FaceKind::periodic}) {
    Parameters p = column(7, 1, 5);
    p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = kind;
    Evaluation e(p);
    e.stress({3000, 2000, 1000, 0, 0, 0});
    e.evaluate();
    for (const Vector3& a : e.rates.acceleration) EXPECT_LT(norm(a), 1e-9);
  }
}

TEST(PairSums, WallsBearTheStressTimesTheirArea) {
  // Uniform stress in a closed box: each wall is pushed by stress times area times the kernel's moment.
  Parameters p = column(7, 3, 5);
  p.box.top = FaceKind::wall;
  Evaluation e(p);
  e.stress({3000, 2000, 1000, 0, 0, 0});
  e.evaluate();
  std::array<double, wall_number(max_inner_walls)> by_wall{};
  for (std::size_t i = 0; i < e.state.position.size(); ++i)
    e.rates.by_walls.of(i, [&](int wall, double a) { by_wall[static_cast<std::size_t>(wall)] += e.state.mass * a; });
  const double d2 = spacing * spacing, m = lattice_moment();
  const double expected[6] = {3000 * 15, -3000 * 15, 2000 * 35, -2000 * 35, 1000 * 21, -1000 * 21};
  for (std::size_t w = 0; w < 6; ++w) EXPECT_NEAR(by_wall[w], expected[w] * d2 * m, 1e-9 * std::abs(expected[w] * d2));
}

TEST(PairSums, ForcesBetweenParticlesCancelAndWallsBearTheRest) {
  Parameters p = column(8, 2, 30);
  p.plate.height = 15 * spacing;
  p.plate.slit_left = 2.3 * spacing;
  p.plate.slit_right = 5.4 * spacing;
  p.bed.bottom = 0;
  p.sph.smoothing = Smoothing::local;
  p.sph.viscosity_alpha = 0.1;
  Evaluation e(p);
  e.disturb(0.3);
  e.randomise(0.9);
  e.evaluate();
  const Evaluation::Accelerations sums = e.accelerations();
  EXPECT_LT(norm(sums.total - sums.by_walls), 1e-13 * sums.size);
  EXPECT_GT(norm(sums.by_walls), 1e-6 * sums.size);
}

TEST(PairSums, ThePlatesTwoSidesDoNotFeelEachOther) {
  Parameters p = column(12, 2, 30);
  p.plate.height = 15 * spacing;
  p.bed.bottom = 0;
  Evaluation both(p);
  both.stress({3000, 2000, 1000, 0, 0, 100});
  both.disturb(0.3);
  Evaluation above(p);
  above.stress({3000, 2000, 1000, 0, 0, 100});
  above.disturb(0.3);
  const double plate = *p.plate.height;
  for (std::size_t i = 0; i < above.state.position.size(); ++i)
    if (above.state.position[i].z < plate) above.state.position[i].z -= 1e3;
  both.evaluate();
  above.evaluate();
  int near = 0;
  for (std::size_t i = 0; i < both.state.position.size(); ++i) {
    const double z = both.state.position[i].z - plate;
    if (z < 0) continue;
    near += z < spacing;
    EXPECT_EQ(both.rates.acceleration[i], above.rates.acceleration[i]);
    EXPECT_EQ(both.rates.kernel_density[i], above.rates.kernel_density[i]);
    EXPECT_EQ(both.rates.velocity_gradient[i], above.rates.velocity_gradient[i]);
  }
  EXPECT_GT(near, 20);
}

TEST(PairSums, ThroughAnOpenSlitTheBedIsWhole) {
  // With the whole plate open, rates are those of a box without one.
  Parameters p = column(8, 2, 30);
  Evaluation without(p);
  without.disturb(0.3);
  without.stress({3000, 2000, 1000, 0, 0, 100});
  p.plate.height = 15 * spacing;
  p.plate.slit_left = 0;
  p.plate.slit_right = 8 * spacing;
  p.bed.bottom = 0;
  Evaluation open(p);
  open.disturb(0.3);
  open.stress({3000, 2000, 1000, 0, 0, 100});
  without.evaluate();
  open.evaluate();
  for (std::size_t i = 0; i < open.state.position.size(); ++i)
    EXPECT_EQ(open.rates.acceleration[i], without.rates.acceleration[i]);
  // With the gate shut they are not.
  p.gate.opens = GateOpens::when_settled;
  Evaluation shut(p);
  shut.disturb(0.3);
  shut.stress({3000, 2000, 1000, 0, 0, 100});
  shut.evaluate();
  EXPECT_NE(shut.rates.acceleration, without.rates.acceleration);
  shut.domain.open_gates();
  shut.evaluate();
  EXPECT_EQ(shut.rates.acceleration, without.rates.acceleration);
}

TEST(PairSums, TheDensityFollowsTheKernelsSum) {
  // Eq. 16 in its pair form is the rate of the kernel's sum, image for image, with a fixed smoothing length.
  Parameters p = column(6, 1, 9, 3);
  Evaluation e(p);
  e.disturb(0.2);
  e.velocity([](const Vector3& x) {
    return Vector3{std::sin(40 * x.z), std::sin(300 * x.x) * x.y, std::cos(50 * x.x)};
  });
  const double dt = 1e-6;
  e.evaluate();
  const auto rate = e.rates.density_rate;
  const auto start = e.state.position;
  const auto at = [&](double time) {
    for (std::size_t i = 0; i < start.size(); ++i) e.state.position[i] = start[i] + time * e.state.velocity[i];
    e.evaluate(PairTerms::forces);
    return e.rates.kernel_density;
  };
  const auto later = at(dt), earlier = at(-dt);
  for (std::size_t i = 0; i < start.size(); ++i)
    EXPECT_NEAR((later[i] - earlier[i]) / (2 * dt), rate[i], 1e-4 * std::abs(rate[i]) + 0.5);
}

TEST(PairSums, TheKernelsPackingOnALatticeIsTheBeds) {
  Evaluation e(column(6, 1, 8, 4));
  e.evaluate();
  for (std::size_t i = 0; i < e.state.position.size(); ++i) {
    if (e.state.position[i].z < 6 * spacing) {
      EXPECT_NEAR(e.rates.kernel_density[i], 1500, 1500 * 2e-4);
    }
  }
}

TEST(PairSums, AWiderKernelSumsOverAllWithinItsSupport) {
  // Density and force of a bed under a linear stress, against sums over the whole lattice.
  for (const double ratio : {1.2, 1.5}) {
    Parameters p = column(8, 1, 12, 4);
    p.sph.smoothing_ratio = ratio;
    Evaluation e(p);
    constexpr double gradient = 1e4;
    for (std::size_t i = 0; i < e.state.position.size(); ++i)
      e.state.material.stress[2][i] = gradient * e.state.position[i].z;
    e.evaluate();
    int inside = 0;
    for (std::size_t i = 0; i < e.state.position.size(); ++i) {
      const double z = e.state.position[i].z / spacing;
      if (z > 8 || z < 4) continue;
      ++inside;
      EXPECT_NEAR(e.rates.kernel_density[i], bulk_density(p) * lattice_density(ratio), 1e-9 * bulk_density(p));
      EXPECT_NEAR(e.rates.acceleration[i].z, -gradient * lattice_moment(ratio) / bulk_density(p), 1e-6);
    }
    EXPECT_EQ(inside, 32);
  }
}

}  // namespace
}  // namespace talus::continuum
