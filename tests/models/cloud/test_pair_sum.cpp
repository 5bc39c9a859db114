// SPDX-License-Identifier: Apache-2.0
/// The sum over pairs against closed forms and against a plain double loop over the same laws, for every instruction
/// set that the processor has.
#include "models/cloud/pair_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "base/error.hpp"
#include "models/cloud/pair_sum_cases.hpp"
#include "numerics/cell_grid.hpp"
#include "physics/hydrodynamics/stokes.hpp"

namespace talus::cloud {
namespace {

using std::numbers::pi;
constexpr double eight_pi_mu = 8 * pi * viscosity;

/// What the class promises: agreement with the exact sum within this part of the largest sum over j of |M_ij F_j|.
double bound(Precision precision) {
  return precision == Precision::double_precision ? 1e-14 : 1e-6;
}

TEST(Mobility, HasTheCaseFilesNames) {
  EXPECT_EQ(choice_name(hydrodynamics::Mobility::rotne_prager_1969), "rotne-prager-1969");
  EXPECT_EQ(choice_name(hydrodynamics::Mobility::zuk_2014), "zuk-2014");
  EXPECT_EQ(choice_name(hydrodynamics::Mobility::none), "none");
}

TEST(PairSum, AgreesWithTheOracleForEveryNumberOfSpheres) {
  std::vector<std::size_t> counts{63, 64, 65, 127, 128, 129, 255, 257, 511, 513, 1031};
  for (std::size_t count = 1; count <= 40; ++count) counts.push_back(count);
  for (const std::size_t count : counts)
    for (const Motion motion : {Motion::xy, Motion::xz, Motion::xyz}) {
      const Spheres spheres = random_spheres(count, count, motion);
      for (const Mobility mobility : both_laws) {
        const Expected expected = oracle(spheres, mobility);
        for_every_set_and_precision([&](InstructionSet set, Precision precision) {
          const auto velocity = velocities(spheres, {mobility, motion, precision, set});
          EXPECT_LE(max_difference(velocity, expected.velocity), bound(precision) * expected.scale)
              << count << " " << name({mobility, motion, precision, set});
        });
      }
    }
}

TEST(PairSum, AddsPairsAcrossTilesOfRowsAndColumns) {
  // More columns than a tile holds in either precision, and tasks of several tiles of rows.
  const Spheres spheres = random_spheres(2900, 5, Motion::xyz);
  const Expected expected = oracle(spheres, Mobility::zuk_2014);
  for_every_set_and_precision([&](InstructionSet set, Precision precision) {
    const auto velocity = velocities(spheres, {Mobility::zuk_2014, Motion::xyz, precision, set});
    EXPECT_LE(max_difference(velocity, expected.velocity), bound(precision) * expected.scale)
        << name({Mobility::zuk_2014, Motion::xyz, precision, set});
  });
}

TEST(PairSum, PairOfEqualSpheres) {
  const double r = 3 * a, f = 1e-4, s = 2.0 / 3.0 * (a / r) * (a / r);
  // On sphere 0 along the line of centres, on sphere 1 across it: 2 (1 - s)/r and (1 + s)/r over 8 pi mu.
  const Spheres spheres{{{0, 0, 0}, {r, 0, 0}}, {{f, 0, 0}, {0, f, 0}}, {a, a}};
  for_every_set_and_precision([&](InstructionSet set, Precision precision) {
    const double tolerance = precision == Precision::double_precision ? 1e-10 : 1e-6;
    for (const Mobility mobility : both_laws)
      for (const Motion motion : {Motion::xy, Motion::xyz}) {
        const auto v = velocities(spheres, {mobility, motion, precision, set});
        EXPECT_NEAR(v[1].x / (f * 2 * (1 - s) / r / eight_pi_mu), 1, tolerance);
        EXPECT_NEAR(v[0].y / (f * (1 + s) / r / eight_pi_mu), 1, tolerance);
        EXPECT_EQ(v[0].x, 0);
        EXPECT_EQ(v[1].y, 0);
        EXPECT_EQ(v[0].z, 0);
      }
  });
}

TEST(PairSum, TripleOfEqualSpheresInALine) {
  const double r = 2.5 * a, f = 1e-4;
  const Spheres spheres{{{0, 0, -r}, {0, 0, 0}, {0, 0, r}}, {{0, 0, f}, {0, 0, f}, {0, 0, f}}, {a, a, a}};
  auto along = [](double distance) { return (2 - 4.0 / 3.0 * a * a / (distance * distance)) / distance; };
  for_every_set_and_precision([&](InstructionSet set, Precision precision) {
    const double tolerance = precision == Precision::double_precision ? 1e-10 : 1e-6;
    for (const Mobility mobility : both_laws)
      for (const Motion motion : {Motion::xz, Motion::xyz}) {
        const auto v = velocities(spheres, {mobility, motion, precision, set});
        EXPECT_NEAR(v[1].z / (f * 2 * along(r) / eight_pi_mu), 1, tolerance);
        EXPECT_NEAR(v[0].z / (f * (along(r) + along(2 * r)) / eight_pi_mu), 1, tolerance);
        EXPECT_NEAR(v[2].z / v[0].z, 1, tolerance);
      }
  });
}

TEST(PairSum, RingOfEqualSpheresPushedAlongItsAxisAndAroundIt) {
  constexpr int n = 24;
  const double radius = 10 * a, f = 1e-4;
  double axial = 0, around = 0;  // over f/(8 pi mu)
  for (int k = 1; k < n; ++k) {
    const double angle = 2 * pi * k / n, r = 2 * radius * std::sin(angle / 2), s = 2.0 / 3.0 * (a / r) * (a / r);
    axial += (1 + s) / r;
    // d.t_0 = d.t_k = -radius sin(angle), t_0.t_k = cos(angle)
    around += ((1 + s) * std::cos(angle) + (1 - 3 * s) * std::pow(radius * std::sin(angle) / r, 2)) / r;
  }
  Spheres ring, turning;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * pi * k / n;
    ring.position.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    ring.force.push_back({0, 0, f});
    ring.radius.push_back(a);
  }
  turning = ring;
  for (int k = 0; k < n; ++k)
    turning.force[k] = {-f * turning.position[k].y / radius, f * turning.position[k].x / radius, 0};
  for_every_set_and_precision([&](InstructionSet set, Precision precision) {
    const double tolerance = precision == Precision::double_precision ? 1e-10 : 1e-6;
    for (const Mobility mobility : both_laws) {
      const auto v = velocities(ring, {mobility, Motion::xyz, precision, set});
      for (const Motion motion : {Motion::xy, Motion::xyz}) {
        const auto w = velocities(turning, {mobility, motion, precision, set});
        for (int k = 0; k < n; ++k) {
          EXPECT_NEAR(v[k].z / (f * axial / eight_pi_mu), 1, tolerance);
          EXPECT_NEAR(dot(w[k], turning.force[k]) / (f * f * around / eight_pi_mu), 1, tolerance);
        }
      }
    }
  });
}

TEST(PairSum, SphericalCloudSettlesAsItsMeanDistanceSays) {
  // N equal spheres at random in a ball of radius R (in radii), centres more than 2 apart, under equal forces. The
  // directions of the pairs are isotropic, so the mean of I + rr/r^2 is 4/3 I and the finite-size terms, being
  // traceless, average out; the mean velocity over a single sphere's is then 1 + (N - 1) <1/r>. For points at random
  // in a ball <1/r> = 6/(5R); pairs nearer than 2, of density 3 r^2/R^3, would add the integral of 3 r/R^3 from 0 to 2,
  // which is 6/R^3. What is left out is of relative order R^-3: here 1e-3.
  constexpr std::size_t count = 200;
  constexpr double ball = 25;
  double mean = 0;
  constexpr int seeds = 50;
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    Spheres cloud;
    while (cloud.size() < count) {
      const Vector3 x{random.uniform(-ball, ball), random.uniform(-ball, ball), random.uniform(-ball, ball)};
      const bool free = std::none_of(cloud.position.begin(), cloud.position.end(),
                                     [&](const Vector3& y) { return norm(x - (1 / a) * y) <= 2; });
      if (norm(x) > ball || !free) continue;
      cloud.position.push_back(a * x);
      cloud.force.push_back({1e-4, 0, 0});
      cloud.radius.push_back(a);
    }
    const double single = 1e-4 * hydrodynamics::stokes_mobility(a, viscosity);
    for (const Vector3& v : velocities(cloud, {}, 2)) mean += (1 + v.x / single) / (count * seeds);
  }
  const double expected = 1 + (count - 1) * (6 / (5 * ball) - 6 / (ball * ball * ball));
  EXPECT_NEAR(mean / expected, 1, 0.01);
}

TEST(PairSum, PlaneIsSpaceForCoplanarSpheres) {
  for (const Motion plane : {Motion::xy, Motion::xz}) {
    const Spheres spheres = random_spheres(150, 9, plane);
    for_every_set_and_precision([&](InstructionSet set, Precision precision) {
      for (const Mobility mobility : both_laws) {
        const double scale = oracle(spheres, mobility).scale;
        const auto flat = velocities(spheres, {mobility, plane, precision, set});
        const auto full = velocities(spheres, {mobility, Motion::xyz, precision, set});
        EXPECT_LE(max_difference(flat, full), bound(precision) * scale);
        for (const Vector3& v : flat) EXPECT_EQ(plane == Motion::xy ? v.z : v.y, 0);
      }
    });
  }
}

TEST(PairSum, SameBitsForAnyNumberOfThreads) {
  for (const Motion motion : {Motion::xy, Motion::xyz}) {
    const Spheres spheres = random_spheres(900, 1, motion);
    for_every_set_and_precision([&](InstructionSet set, Precision precision) {
      for (const Mobility mobility : both_laws) {
        const PairSum::Options options{mobility, motion, precision, set};
        const auto one = velocities(spheres, options, 1);
        for (const int threads : {2, 3})
          for (int repeat = 0; repeat < 3; ++repeat)
            EXPECT_EQ(velocities(spheres, options, threads), one) << name(options);
      }
    });
  }
}

TEST(PairSum, OrderChangesNoMoreThanTheLastBits) {
  const Spheres spheres = random_spheres(700, 2, Motion::xyz);
  const Expected expected = oracle(spheres, Mobility::rotne_prager_1969);
  const auto sorted = spatial_order(spheres.position, 4 * a);
  std::vector<std::uint32_t> backward(spheres.size());
  std::iota(backward.rbegin(), backward.rend(), 0u);
  for_every_set_and_precision([&](InstructionSet set, Precision precision) {
    ThreadTeam team;
    PairSum sum({Mobility::rotne_prager_1969, Motion::xyz, precision, set, viscosity}, spheres.radius, sorted);
    std::vector<Vector3> velocity(spheres.size()), again(spheres.size());
    sum.velocities(team, spheres.position, spheres.force, velocity);
    EXPECT_LE(max_difference(velocity, expected.velocity), bound(precision) * expected.scale);
    sum.reorder(backward);
    sum.velocities(team, spheres.position, spheres.force, again);
    EXPECT_LE(max_difference(again, expected.velocity), bound(precision) * expected.scale);
    sum.reorder(sorted);
    sum.velocities(team, spheres.position, spheres.force, again);
    EXPECT_EQ(again, velocity);
  });
}

TEST(PairSum, SinglePrecisionKeepsSixDigitsOfASortedCloud) {
  // Under weight and contact forces of its size; measured: 2e-7 of the largest velocity, 4e-7 for the portable loop,
  // which adds more numbers up in each lane.
  for (const Motion motion : {Motion::xy, Motion::xyz}) {
    Spheres spheres = random_spheres(2000, 3, motion);
    for (Vector3& force : spheres.force) force.x += 1e-4;
    const auto order = spatial_order(spheres.position, 4 * a);
    const auto exact = velocities(spheres, {Mobility::rotne_prager_1969, motion}, 1, order);
    double largest = 0;
    for (const Vector3& v : exact) largest = std::max(largest, norm(v));
    for (const InstructionSet set : available_sets()) {
      const PairSum::Options options{Mobility::rotne_prager_1969, motion, Precision::single_precision, set};
      const double error = max_difference(velocities(spheres, options, 1, order), exact) / largest;
      EXPECT_LE(error, 1e-6) << name(options);
      EXPECT_GE(error, 1e-9) << name(options);  // it is single precision
    }
  }
}

TEST(PairSum, TwoSpheresAtOnePlace) {
  Spheres spheres = random_spheres(40, 4, Motion::xyz);
  spheres.position[33] = spheres.position[7];
  for_every_set_and_precision([&](InstructionSet set, Precision precision) {
    const auto printed = velocities(spheres, {Mobility::rotne_prager_1969, Motion::xyz, precision, set});
    for (std::size_t i = 0; i < spheres.size(); ++i) EXPECT_EQ(std::isfinite(norm(printed[i])), i != 7 && i != 33) << i;
    const auto symmetric = velocities(spheres, {Mobility::zuk_2014, Motion::xyz, precision, set});
    EXPECT_LE(max_difference(symmetric, oracle(spheres, Mobility::zuk_2014).velocity),
              bound(precision) * oracle(spheres, Mobility::zuk_2014).scale);
  });
}

TEST(PairSum, PassesOnWhatIsNotFinite) {
  for (const Mobility mobility : both_laws)
    for_every_set_and_precision([&](InstructionSet set, Precision precision) {
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Spheres spheres = random_spheres(20, 4, Motion::xyz);
        spheres.position[3].y = bad;
        EXPECT_FALSE(std::isfinite(norm(velocities(spheres, {mobility, Motion::xyz, precision, set})[3])));
        spheres = random_spheres(20, 4, Motion::xyz);
        spheres.force[3].y = bad;
        EXPECT_FALSE(std::isfinite(norm(velocities(spheres, {mobility, Motion::xyz, precision, set})[11])));
      }
    });
}

TEST(PairSum, WithoutInteractionEveryVelocityIsZero) {
  const Spheres spheres = random_spheres(20, 1, Motion::xyz);
  for (const Vector3& v : velocities(spheres, {.mobility = Mobility::none})) EXPECT_EQ(v, Vector3{});
  EXPECT_TRUE(velocities(Spheres{}, {}).empty());
}

TEST(PairSum, RefusesWhatDoesNotFit) {
  const Spheres spheres = random_spheres(5, 1, Motion::xyz);
  ThreadTeam team;
  PairSum sum({.viscosity = viscosity}, spheres.radius);
  std::vector<Vector3> velocity(4);
  EXPECT_THROW(sum.velocities(team, spheres.position, spheres.force, velocity), std::invalid_argument);
  EXPECT_THROW(sum.reorder(std::vector<std::uint32_t>{0, 1}), std::invalid_argument);
  EXPECT_THROW(sum.reorder(std::vector<std::uint32_t>{0, 1, 2, 3, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace talus::cloud
